// SPDX-License-Identifier: Apache-2.0
#include "lights/area.h"

#include <algorithm>

namespace tenniel {

namespace {

// Below this a spherical rectangle has lost its digits and the plain area does better.
constexpr float k_min_solid_angle = 1e-3f;

}  // namespace

SphericalRectangle AreaLight::seen_from(Vec3 from) const {
  return SphericalRectangle(from, center - (edge_u + edge_v) * 0.5f, axis_u, axis_v, length_u,
                            length_v);
}

void AreaLight::set_place(Vec3 center_point, Vec3 full_edge_u, Vec3 full_edge_v,
                          Vec3 shining_side) {
  center = center_point;
  edge_u = full_edge_u;
  edge_v = full_edge_v;
  normal = shining_side;
  length_u = length(edge_u);
  length_v = length(edge_v);
  axis_u = normalize_or(edge_u, {1.0f, 0.0f, 0.0f});
  axis_v = normalize_or(edge_v, {0.0f, 1.0f, 0.0f});
  is_rectangle = std::abs(dot(axis_u, axis_v)) <= 1e-4f;
  const Vec3 plane = cross(edge_u, edge_v);
  const float squared = length_squared(plane);
  if (!(squared > 0.0f)) return;
  dual_u = cross(edge_v, plane) / squared;
  dual_v = cross(plane, edge_u) / squared;
}

// Blender 3.4: with a = (pi - max(spread, 1 degree)) / 2 the radiance is scaled
// by (1 - tan a tan t) * 2 / (2 + (2a - pi) tan a), t the angle to the normal.
void AreaLight::set_spread(float spread) {
  const float a = 0.5f * (k_pi - std::max(spread, k_pi / 180.0f));
  if (a <= 1e-5f) return;
  tan_spread = std::tan(a);
  spread_normalization = 2.0f / (2.0f + (2.0f * a - k_pi) * tan_spread);
}

float AreaLight::attenuation(float cosine) const {
  if (tan_spread == 0.0f) return 1.0f;
  const float tangent = safe_sqrt(1.0f - sqr(cosine)) / cosine;
  return std::max((1.0f - tan_spread * tangent) * spread_normalization, 0.0f);
}

float AreaLight::pdf(Vec3 from, float distance, float cosine) const {
  if (is_rectangle && !is_ellipse) {
    const SphericalRectangle rectangle = seen_from(from);
    if (rectangle.solid_angle() > k_min_solid_angle) return rectangle.pdf();
  }
  return sqr(distance) / (area() * cosine);
}

std::optional<LightSample> AreaLight::sample(const ShadingPoint& point, Vec2 u) const {
  if (dot(point.position - center, normal) <= 0.0f) return {};
  Vec3 on_light;
  float solid_angle = 0.0f;
  if (is_ellipse) {
    const Vec2 disk = warp_concentric_disk(u) * 0.5f;
    on_light = center + edge_u * disk.x + edge_v * disk.y;
  } else {
    const SphericalRectangle rectangle = seen_from(point.position);
    if (is_rectangle && rectangle.solid_angle() > k_min_solid_angle) {
      solid_angle = rectangle.solid_angle();
      on_light = rectangle.sample(u);
    } else {
      on_light = center + edge_u * (u.x - 0.5f) + edge_v * (u.y - 0.5f);
    }
  }
  const Vec3 to_light = on_light - point.position;
  const float distance = length(to_light);
  const Vec3 wi = to_light / distance;
  const float cosine = -dot(wi, normal);
  if (!(cosine > 0.0f)) return {};
  const float factor = attenuation(cosine);
  if (factor == 0.0f) return {};
  const float density = solid_angle > 0.0f ? 1.0f / solid_angle : sqr(distance) / (area() * cosine);
  return LightSample{wi, distance, radiance * factor, density, false};
}

std::optional<LampHit> AreaLight::intersect(const Ray& ray) const {
  const float cosine = -dot(ray.direction, normal);
  if (!(cosine > 0.0f)) return {};
  const float t = -dot(center - ray.origin, normal) / cosine;
  if (!(t > ray.t_min) || t >= ray.t_max) return {};
  const Vec3 local = ray.at(t) - center;
  const float u = dot(local, dual_u), v = dot(local, dual_v);
  const bool inside =
      is_ellipse ? sqr(u) + sqr(v) <= 0.25f : std::abs(u) <= 0.5f && std::abs(v) <= 0.5f;
  if (!inside) return {};
  return LampHit{t, radiance * attenuation(cosine), pdf(ray.origin, t, cosine)};
}

}  // namespace tenniel
