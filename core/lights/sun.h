// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lights/light_types.h"
#include "math/frame.h"
#include "math/ray.h"
#include "sampling/warp.h"

namespace tenniel {

// Blender 3.4's sun: seen as a disk of radius tan(angle / 2) at distance 1, radiance
// strength / (pi tan^2 a cos^3 t) so that a facing plane receives `irradiance`.
struct SunLight {
  Vec3 axis;                 // unit, from the scene toward the sun
  float disk_radius = 0.0f;  // tan(angle / 2); 0 = one direction
  Spectrum irradiance;

  std::optional<LightSample> sample(const ShadingPoint&, Vec2 u) const {
    if (disk_radius == 0.0f) return LightSample{axis, k_infinity, irradiance, 1.0f, true};
    const Vec2 disk = warp_concentric_disk(u) * disk_radius;
    const Frame frame = Frame::from_normal(axis);
    const Vec3 wi = normalize(axis + frame.x * disk.x + frame.y * disk.y);
    const float density = pdf(dot(wi, axis));
    return LightSample{wi, k_infinity, irradiance * density, density, false};
  }

  std::optional<LampHit> intersect(const Ray& ray) const {
    const float cosine = dot(ray.direction, axis);
    if (disk_radius == 0.0f) return {};
    if (!is_on_disk(cosine)) return {};
    return LampHit{k_infinity, irradiance * pdf(cosine)};
  }

  float pdf(const ShadingPoint&, Vec3 wi) const {
    const float cosine = dot(wi, axis);
    return disk_radius > 0.0f && is_on_disk(cosine) ? pdf(cosine) : 0.0f;
  }

 private:
  bool is_on_disk(float cosine) const {
    return cosine > 0.0f && 1.0f / sqr(cosine) - 1.0f <= sqr(disk_radius);
  }
  // d(disk area) / d(solid angle) = 1 / cos^3 at distance 1.
  float pdf(float cosine) const { return 1.0f / (k_pi * sqr(disk_radius) * cosine * sqr(cosine)); }
};

}  // namespace tenniel
