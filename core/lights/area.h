// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lights/light_types.h"
#include "math/frame.h"
#include "math/ray.h"
#include "sampling/warp.h"

namespace tenniel {

// Blender's area lamp: a rectangle or an ellipse that shines on one side.
struct AreaLight {
  // A number for each corner, computed with together.
  using Corners = float __attribute__((vector_size(16)));

  Vec3 center;
  Vec3 edge_u, edge_v;  // full extents, world space
  Vec3 normal;          // unit, the side that shines
  Vec3 axis_u, axis_v;  // unit, along the edges
  float length_u = 0.0f, length_v = 0.0f;
  Vec3 dual_u, dual_v;  // coordinates along the edges of a point in the plane; sheared lamps too
  Corners corners_x{}, corners_y{}, corners_z{};  // from the center
  float parallelogram = 0.0f;                     // area spanned by the edges
  float inverse_parallelogram = k_infinity;
  bool is_ellipse = false;
  bool is_rectangle = true;  // perpendicular edges: sampled by solid angle from nearby
  Spectrum radiance;         // along the normal
  float tan_spread = 0.0f;   // tan of the complement of half the spread; 0 = no limit
  float spread_normalization = 1.0f;

  float inverse_area() const {
    return is_ellipse ? inverse_parallelogram * (4.0f / k_pi) : inverse_parallelogram;
  }
  float area() const { return is_ellipse ? parallelogram * (k_pi / 4.0f) : parallelogram; }
  // Sets center, edges and what follows from them.
  void set_place(Vec3 center_point, Vec3 full_edge_u, Vec3 full_edge_v, Vec3 shining_side);
  // Sets the limit of the beam; `spread` is Blender's full angle in radians.
  void set_spread(float spread);
  std::optional<LightSample> sample(const ShadingPoint& point, Vec2 u) const;
  std::optional<LampHit> intersect(const Ray& ray) const;
  float pdf(const ShadingPoint& point, Vec3 wi) const;
  // About how much brighter than without a limit of its beam the lamp is at a point; zero only
  // where no part of the beam arrives.
  float beam_estimate(Vec3 point) const;

 private:
  // How a point draws places on the lamp.
  enum class Method { uniform_area, bilinear, solid_angle };
  Method method_for(Vec3 from) const;
  SphericalRectangle seen_from(Vec3 from) const;
  BilinearSquare irradiance_estimate(const ShadingPoint& point) const;
  float attenuation(float cosine) const;
};

// Here for the sake of speed: every ray of a path asks each lamp.
inline std::optional<LampHit> AreaLight::intersect(const Ray& ray) const {
  // One branch, which is almost never taken, for all conditions.
  const float cosine = -dot(ray.direction, normal);
  const float t = -dot(center - ray.origin, normal) / cosine;
  const Vec3 local = ray.at(t) - center;
  const float u = std::abs(dot(local, dual_u)), v = std::abs(dot(local, dual_v));
  const bool inside = is_ellipse ? sqr(u) + sqr(v) <= 0.25f : std::max(u, v) <= 0.5f;
  if (!(inside & (cosine > 0.0f) & (t > ray.t_min) & (t < ray.t_max))) return {};
  return LampHit{t, radiance * attenuation(cosine)};
}

}  // namespace tenniel
