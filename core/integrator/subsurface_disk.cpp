// SPDX-License-Identifier: Apache-2.0
// King et al. 2013, "BSSRDF Importance Sampling": a point of a disk around the entry, projected
// onto the surface along one of three axes.
#include <array>
#include <cmath>

#include "bsdf/burley_profile.h"
#include "integrator/subsurface.h"
#include "math/frame.h"

namespace tenniel {

namespace {

constexpr size_t k_max_hits = 16;

// The axis in use first, then its two perpendiculars, each with the share of probes along it.
struct ProbeAxes {
  std::array<Vec3, 3> axis;
  std::array<float, 3> share{0.5f, 0.25f, 0.25f};

  // `u` is turned into a new number.
  ProbeAxes(const Frame& frame, float& u) : axis{frame.z, frame.x, frame.y} {
    const size_t first = u < 0.5f ? 0 : u < 0.75f ? 1 : 2;
    u = first == 0 ? 2.0f * u : 4.0f * (u - (first == 1 ? 0.5f : 0.75f));
    std::swap(axis[0], axis[first]);
    std::swap(share[0], share[first]);
  }

  // Weight of a point that the first axis met, by the power heuristic over all three, over its
  // density per area of the surface in units of the disk's.
  float weight(Vec3 normal) const {
    float squares = 0.0f;
    for (size_t i = 0; i < 3; ++i)
      squares += sqr(share[i] * dot(axis[i], normal));
    return squares > 0.0f ? share[0] * abs_dot(axis[0], normal) / squares : 0.0f;
  }
};

float total(Spectrum s) {
  return s.r + s.g + s.b;
}

}  // namespace

std::optional<SubsurfaceExit> probe_nearby(const ObjectBelow& object, const Subsurface& lobe,
                                           const SubsurfaceEntry& entry) {
  const BurleyProfile profile(lobe.radius);
  if (profile.empty()) return {};
  Vec2 u = entry.u;
  const SurfaceInteraction& at = entry.at;
  const ProbeAxes axes(Frame::from_normal(at.geometric_normal), u.y);
  const BurleyProfile::Distance on_disk = profile.sample(u.x);
  const float phi = k_two_pi * u.y;
  const float height = safe_sqrt(sqr(on_disk.farthest) - sqr(on_disk.r));
  const float pdf = profile.pdf(on_disk.r);
  if (!(pdf > 0.0f) || !(height > 0.0f) || !(height < k_farthest_below)) return {};

  SubsurfaceExit exit;
  Ray probe;
  probe.origin = at.position + axes.axis[0] * height + axes.axis[1] * (on_disk.r * std::cos(phi)) +
                 axes.axis[2] * (on_disk.r * std::sin(phi));
  probe.direction = -axes.axis[0];
  probe.t_max = 2.0f * height;
  probe.time = at.time;
  std::array<Hit, k_max_hits> hits;
  const size_t count = object.intersect_all(probe, hits);

  // One of the hits in proportion to its weight: what the profile says over the density.
  std::array<Spectrum, k_max_hits> weights;
  std::array<Vec3, k_max_hits> normals;
  float sum = 0.0f;
  for (size_t i = 0; i < count; ++i) {
    const SurfaceInteraction there = object.interaction(probe, hits[i]);
    // On the side that the entry is on, of the object itself.
    const bool is_turned = there.is_back_facing != at.is_back_facing;
    normals[i] = is_turned ? -there.geometric_normal : there.geometric_normal;
    const float r = length(there.position - at.position);
    weights[i] = profile.density(r) * (axes.weight(normals[i]) / pdf);
    sum += total(weights[i]);
  }
  if (!(sum > 0.0f)) return {};
  float rest = entry.choice * sum;
  size_t chosen = 0;
  while (chosen + 1 < count && rest >= total(weights[chosen]))
    rest -= total(weights[chosen++]);
  const float own = total(weights[chosen]);
  if (!(own > 0.0f)) return {};

  exit.hit = hits[chosen];
  exit.ray.origin = probe.at(exit.hit.t) + normals[chosen] * on_disk.farthest;
  exit.ray.direction = -normals[chosen];
  exit.ray.time = at.time;
  exit.hit.t = on_disk.farthest;
  exit.throughput = entry.throughput * weights[chosen] * (sum / own);
  return exit;
}

}  // namespace tenniel
