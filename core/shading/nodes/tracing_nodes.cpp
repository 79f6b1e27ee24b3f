// SPDX-License-Identifier: Apache-2.0
// Nodes that look around from the point they shade.
#include <algorithm>
#include <array>
#include <cmath>

#include "math/frame.h"
#include "math/hash.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "shading/node_type.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

// The same numbers for the same point of the same path.
LocalRandom random_at(const SurfaceInteraction& surface, uint32_t salt) {
  const Vec3 p = surface.position, d = surface.wo;
  const uint32_t place = hash_uint(float_bits(p.x), float_bits(p.y), float_bits(p.z));
  return LocalRandom(hash_uint(place, float_bits(d.x), float_bits(d.y), salt));
}

bool can_trace(const ShadingContext& context) {
  return context.rays && context.surface.mesh && context.domain == ShaderDomain::surface;
}

struct AmbientOcclusionNode {
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> distance{1.0f};
  Input<Vec3> normal;
  Output<Spectrum> shaded;
  Output<float> factor;
  int samples = 16;
  bool inside = false, only_local = false;

  void eval(ShadingContext& context) const {
    const float open = openness(context);
    context.set(factor, open);
    context.set(shaded, context.get(color) * open);
  }

  // Cosine-weighted share of the hemisphere that is free.
  float openness(const ShadingContext& context) const {
    if (samples < 1 || !can_trace(context)) return 1.0f;
    const bool is_unset = !distance.linked() && distance.value == 0.0f;
    const float reach = is_unset ? context.rays->occlusion_distance : context.get(distance);
    if (!(reach > 0.0f)) return 1.0f;
    const Vec3 n = context.normal(normal);
    const Frame frame = Frame::from_normal(inside ? -n : n);
    LocalRandom random = random_at(context.surface, 0x3ab1u);
    int free = 0;
    for (int i = 0; i < samples; ++i) {
      // Strata along one axis.
      const Vec2 u = random.get_2d();
      const float x = (static_cast<float>(i) + u.x) / static_cast<float>(samples);
      const Vec3 direction = frame.to_world(warp_cosine_hemisphere({x, u.y}));
      free += context.rays->is_free(context.surface, normalize(direction), reach,
                                    context.path.world, only_local)
                  ? 1
                  : 0;
    }
    return static_cast<float>(free) / static_cast<float>(samples);
  }
};

// Density of the disk that bevel samples: falls with the cube of the distance to the rim.
float bevel_density(float radius, float r) {
  if (r >= radius) return 0.0f;
  const float rest = 1.0f - r / radius;
  return 10.0f * rest * rest * rest / (k_pi * sqr(radius));
}

// Solves u = 10 x^2 - 20 x^3 + 15 x^4 - 4 x^5, the share of the disk within x radii.
float bevel_radius(float u) {
  float x = 0.25f;
  for (int i = 0; i < 10; ++i) {
    const float value = sqr(x) * (10.0f + x * (-20.0f + x * (15.0f - 4.0f * x))) - u;
    const float slope = 20.0f * x * (1.0f - x) * sqr(1.0f - x);
    if (std::abs(value) < 1e-6f || slope == 0.0f) break;
    x = saturate(x - value / slope);
  }
  return x;
}

// Normals gathered over a disk around the point by probes along three axes, as disk-sampled
// subsurface scattering (King et al. 2013, "BSSRDF Importance Sampling") places its points.
struct BevelNode {
  Input<float> radius{0.05f};
  Input<Vec3> normal;
  Output<Vec3> result;
  int samples = 4;

  void eval(ShadingContext& context) const {
    const Vec3 n = context.surface.shading_normal;
    const Vec3 bevelled = gathered(context);
    context.set(result,
                normal.linked() ? normalize_or(context.get(normal) + bevelled - n, n) : bevelled);
  }

 private:
  static constexpr size_t k_max_hits = 8;

  Vec3 gathered(const ShadingContext& context) const {
    const SurfaceInteraction& at = context.surface;
    const float reach = context.get(radius);
    // Light from afar does not show an edge; nor does a diffuse bounce.
    const bool is_blurred = context.path.diffuse_depth > 0;
    if (!(reach > 0.0f) || samples < 1 || is_blurred || !can_trace(context))
      return at.shading_normal;
    LocalRandom random = random_at(at, 0x64c6u);
    Vec3 sum;
    for (int i = 0; i < samples; ++i)
      sum += probe(context, reach, random);
    // Normals of the object itself: the side that was hit is turned back at the end.
    return normalize_or(at.is_back_facing ? -sum : sum, at.shading_normal);
  }

  Vec3 probe(const ShadingContext& context, float reach, LocalRandom& random) const {
    const SurfaceInteraction& at = context.surface;
    const Frame frame = Frame::from_normal(at.geometric_normal);
    // The probe's axis: mostly the normal, a quarter each of its two perpendiculars.
    std::array<Vec3, 3> axes{frame.z, frame.x, frame.y};
    std::array<float, 3> share{0.5f, 0.25f, 0.25f};
    const float pick = random.get_1d();
    const size_t along = pick < 0.5f ? 0 : pick < 0.75f ? 1 : 2;
    std::swap(axes[0], axes[along]);
    std::swap(share[0], share[along]);
    const float phi = k_two_pi * random.get_1d();
    const float r = reach * bevel_radius(random.get_1d());
    const float height = safe_sqrt(sqr(reach) - sqr(r));
    if (!(height > 0.0f)) return {};
    const Vec3 on_disk = axes[1] * (r * std::cos(phi)) + axes[2] * (r * std::sin(phi));
    Ray ray;
    ray.origin = at.position + axes[0] * height + on_disk;
    ray.direction = -axes[0];
    ray.t_max = 2.0f * height;
    std::array<OwnHit, k_max_hits> hits;
    const size_t count = context.rays->own_hits(at, ray, hits);
    const float disk_density = bevel_density(reach, r);
    Vec3 sum;
    for (size_t h = 0; h < count && disk_density > 0.0f; ++h) {
      float squares = 0.0f, own = 0.0f;
      for (size_t a = 0; a < 3; ++a) {
        const float density = share[a] * abs_dot(axes[a], hits[h].geometric_normal);
        squares += sqr(density);
        if (a == 0) own = density;
      }
      if (!(squares > 0.0f)) continue;
      const float true_r = length(hits[h].position - at.position);
      sum += hits[h].shading_normal * (own / squares * bevel_density(reach, true_r) / disk_density);
    }
    return sum;
  }
};

}  // namespace

void register_tracing_nodes(NodeRegistry& registry) {
  registry.add<AmbientOcclusionNode>("ShaderNodeAmbientOcclusion")
      .input("Color", &AmbientOcclusionNode::color)
      .input("Distance", &AmbientOcclusionNode::distance)
      .input("Normal", &AmbientOcclusionNode::normal)
      .implicit(ImplicitInput::normal)
      .output("Color", &AmbientOcclusionNode::shaded)
      .output("AO", &AmbientOcclusionNode::factor)
      .setting("samples", &AmbientOcclusionNode::samples)
      .setting("inside", &AmbientOcclusionNode::inside)
      .setting("only_local", &AmbientOcclusionNode::only_local)
      .varying();
  registry.add<BevelNode>("ShaderNodeBevel")
      .input("Radius", &BevelNode::radius)
      .input("Normal", &BevelNode::normal)
      .implicit(ImplicitInput::normal)
      .output("Normal", &BevelNode::result)
      .setting("samples", &BevelNode::samples)
      .varying();
}

}  // namespace tenniel
