// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lights/light_types.h"
#include "math/frame.h"
#include "math/ray.h"
#include "sampling/warp.h"

namespace tenniel {

// Blender's point lamp: a disk of `radius` that always faces whoever looks at it, or a point.
struct PointLight {
  Vec3 position;
  float radius = 0.0f;
  Spectrum radiance;  // of the disk; radius 0: the intensity per steradian

  float area() const { return k_pi * sqr(radius); }

  std::optional<LightSample> sample(const ShadingPoint& point, Vec2 u) const {
    const Vec3 to_center = position - point.position;
    const float center_distance = length(to_center);
    if (!(center_distance > 0.0f)) return {};
    const Vec3 axis = to_center / center_distance;
    if (radius == 0.0f)
      return LightSample{axis, center_distance, radiance / sqr(center_distance), 1.0f, true};
    const Vec2 disk = warp_concentric_disk(u) * radius;
    const Frame frame = Frame::from_normal(axis);
    const Vec3 to_light = to_center + frame.x * disk.x + frame.y * disk.y;
    const float distance = length(to_light);
    const Vec3 wi = to_light / distance;
    return LightSample{wi, distance, radiance, pdf(distance, dot(wi, axis)), false};
  }

  std::optional<LampHit> intersect(const Ray& ray) const {
    const auto place = meet(ray.origin, ray.direction);
    if (!place) return {};
    return LampHit{place->distance, radiance};
  }

  // Density of `sample` toward `wi`.
  float pdf(const ShadingPoint& point, Vec3 wi) const {
    const auto place = meet(point.position, wi);
    return place ? pdf(place->distance, place->cosine) : 0.0f;
  }

 private:
  struct Place {
    float distance, cosine;
  };
  std::optional<Place> meet(Vec3 from, Vec3 wi) const {
    const Vec3 to_center = position - from;
    const float center_distance = length(to_center);
    if (!(center_distance > 0.0f)) return {};
    const float cosine = dot(wi, to_center / center_distance);
    if (!(cosine > 0.0f)) return {};
    const float t = center_distance / cosine;
    if (length_squared(wi * t - to_center) > sqr(radius)) return {};
    return Place{t, cosine};
  }
  float pdf(float distance, float cosine) const { return sqr(distance) / (area() * cosine); }
};

}  // namespace tenniel
