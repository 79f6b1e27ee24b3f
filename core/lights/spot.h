// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lights/point.h"

namespace tenniel {

// Blender 3.4's spot lamp: a point lamp times cos(angle to the axis) times a smooth edge.
struct SpotLight {
  PointLight point;
  Vec3 axis;                    // unit, where it shines
  float cos_half_angle = 0.0f;  // no light beyond
  float blend = 0.0f;           // width of the edge as a part of 1 - cos_half_angle

  float attenuation(Vec3 direction_from_light) const {
    const float cosine = dot(axis, direction_from_light);
    if (cosine <= cos_half_angle) return 0.0f;
    const float edge = (1.0f - cos_half_angle) * blend;
    const float inside = cosine - cos_half_angle;
    return cosine * (inside < edge ? smoothstep(inside / edge) : 1.0f);
  }

  std::optional<LightSample> sample(const ShadingPoint& at, Vec2 u) const {
    auto result = point.sample(at, u);
    if (!result) return {};
    const float factor = attenuation(-result->wi);
    if (factor == 0.0f) return {};
    result->radiance *= factor;
    return result;
  }

  std::optional<LampHit> intersect(const Ray& ray) const {
    auto hit = point.intersect(ray);
    if (hit) hit->radiance *= attenuation(-ray.direction);
    return hit;
  }

  float pdf(const ShadingPoint& at, Vec3 wi) const { return point.pdf(at, wi); }
};

}  // namespace tenniel
