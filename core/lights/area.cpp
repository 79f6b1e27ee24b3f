// SPDX-License-Identifier: Apache-2.0
#include "lights/area.h"

#include <algorithm>

namespace tenniel {

namespace {

// From further away than the root of this many areas a lamp is drawn by the estimate at its
// corners, nearer by its solid angle.
constexpr float k_near = 2.0f;

// Least share of the brightest corner that any corner is drawn with: normal maps shade with other
// normals than the point's.
constexpr float k_min_share = 0.05f;

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
  for (int i = 0; i < 4; ++i) {
    const Vec3 corner = edge_u * (i % 2 == 0 ? -0.5f : 0.5f) + edge_v * (i < 2 ? -0.5f : 0.5f);
    corners_x[i] = corner.x;
    corners_y[i] = corner.y;
    corners_z[i] = corner.z;
  }
  const float squared = length_squared(plane);
  parallelogram = std::sqrt(squared);
  inverse_parallelogram = 1.0f / parallelogram;
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

// The radiance at the nearest part of the lamp, dimmed where the cone of directions that arrive
// holds but a part of it: the mean of 1 - tan a tan t over that cone's disk is a third.
float AreaLight::beam_estimate(Vec3 point) const {
  if (tan_spread == 0.0f) return 1.0f;
  const Vec3 from_center = point - center;
  const float height = dot(from_center, normal);
  if (!(height > 0.0f)) return 0.0f;
  const float radius =
      0.5f * std::sqrt(std::max(length_squared(edge_u + edge_v), length_squared(edge_u - edge_v)));
  const float aside = std::max(length(from_center - normal * height) - radius, 0.0f);
  const float peak = std::max(1.0f - tan_spread * aside / height, 0.0f) * spread_normalization;
  const float seen = k_pi / 3.0f * sqr(height / tan_spread) / area();
  return peak * std::min(seen, 1.0f);
}

AreaLight::Method AreaLight::method_for(Vec3 from) const {
  if (is_ellipse) return Method::uniform_area;
  const bool is_near = length_squared(center - from) < k_near * parallelogram;
  return is_near && is_rectangle ? Method::solid_angle : Method::bilinear;
}

// What each corner sends to the point, up to a factor: cosines at both ends over the squared
// distance (after Hart et al. 2020, "Practical Product Sampling by Fitting and Composing Warps").
// The cosine at the lamp is the height above its plane, common to all corners, over the distance.
BilinearSquare AreaLight::irradiance_estimate(const ShadingPoint& point) const {
  const Vec3 to_center = center - point.position, n = point.normal;
  const Corners x = corners_x + to_center.x, y = corners_y + to_center.y,
                z = corners_z + to_center.z;
  const Corners d2 = x * x + y * y + z * z;
  Corners height;
  if (point.has_hemisphere) {
    height = x * n.x + y * n.y + z * n.z;
    height = height > 0.0f ? height : Corners{};
  } else {
    for (int i = 0; i < 4; ++i)
      height[i] = std::sqrt(d2[i]);
  }
  const Corners value = height / (d2 * d2);
  const float largest = std::max(std::max(value[0], value[1]), std::max(value[2], value[3]));
  if (!(largest > 0.0f)) return BilinearSquare({1.0f, 1.0f, 1.0f, 1.0f});
  const float least = k_min_share * largest;
  const Corners raised = value > least ? value : least + Corners{};
  return BilinearSquare({raised[0], raised[1], raised[2], raised[3]});
}

float AreaLight::pdf(const ShadingPoint& point, Vec3 wi) const {
  const float cosine = -dot(wi, normal);
  const Vec3 to_center = center - point.position;
  const float distance = -dot(to_center, normal) / cosine;
  if (!(cosine > 0.0f) || !(distance > 0.0f)) return 0.0f;
  const Method method = method_for(point.position);
  if (method == Method::solid_angle) {
    const SphericalRectangle rectangle = seen_from(point.position);
    if (rectangle.solid_angle() > 0.0f) return rectangle.pdf();
  }
  float by_area = inverse_area();
  if (method == Method::bilinear) {
    const Vec3 local = wi * distance - to_center;
    by_area *=
        irradiance_estimate(point).pdf({dot(local, dual_u) + 0.5f, dot(local, dual_v) + 0.5f});
  }
  return by_area * sqr(distance) / cosine;
}

std::optional<LightSample> AreaLight::sample(const ShadingPoint& point, Vec2 u) const {
  const Vec3 to_center = center - point.position;
  if (dot(to_center, normal) >= 0.0f) return {};
  Vec3 to_light;
  float solid_angle = 0.0f, by_area = inverse_area();
  switch (method_for(point.position)) {
    case Method::uniform_area: {
      const Vec2 disk = warp_concentric_disk(u) * 0.5f;
      to_light = to_center + edge_u * disk.x + edge_v * disk.y;
      break;
    }
    case Method::bilinear: {
      const BilinearSquare estimate = irradiance_estimate(point);
      const Vec2 at = estimate.sample(u);
      by_area *= estimate.pdf(at);
      to_light = to_center + edge_u * (at.x - 0.5f) + edge_v * (at.y - 0.5f);
      break;
    }
    case Method::solid_angle: {
      const SphericalRectangle rectangle = seen_from(point.position);
      solid_angle = rectangle.solid_angle();
      to_light = solid_angle > 0.0f ? rectangle.sample(u) - point.position
                                    : to_center + edge_u * (u.x - 0.5f) + edge_v * (u.y - 0.5f);
      break;
    }
  }
  const float distance = length(to_light);
  const Vec3 wi = to_light / distance;
  const float cosine = -dot(wi, normal);
  if (!(cosine > 0.0f)) return {};
  const float factor = attenuation(cosine);
  if (factor == 0.0f) return {};
  const float density = solid_angle > 0.0f ? 1.0f / solid_angle : by_area * sqr(distance) / cosine;
  return LightSample{wi, distance, radiance * factor, density, false};
}

}  // namespace tenniel
