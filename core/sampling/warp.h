// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numeric.h"
#include "math/vec.h"

// Maps of the unit square that carry its uniform density to another domain, each with the density
// that results. Directions are in a local frame around +z; a pdf of directions is per solid angle.
namespace tenniel {

// Unit disk (Shirley & Chiu 1997): keeps neighbours and areas, hence the stratification.
inline Vec2 warp_concentric_disk(Vec2 u) {
  const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
  const bool x_leads = std::abs(a) > std::abs(b);
  const float radius = x_leads ? a : b, other = x_leads ? b : a;
  if (radius == 0.0f) return {};
  const float phi = 0.25f * k_pi * (other / radius);
  const Vec2 along{radius * cos_near_zero(phi), radius * sin_near_zero(phi)};
  return x_leads ? along : Vec2{along.y, along.x};
}
constexpr float concentric_disk_pdf() {
  return k_inv_pi;
}

// Regular polygon inscribed in the unit circle, a corner at angle `rotation`; `sides` >= 3.
inline Vec2 warp_regular_polygon(Vec2 u, int sides, float rotation) {
  const float scaled = u.x * static_cast<float>(sides);
  const float wedge = std::min(std::floor(scaled), static_cast<float>(sides - 1));
  const float root = std::sqrt(u.y);
  const float to_next = std::min(scaled - wedge, 1.0f) * root, to_this = root - to_next;
  const float step = k_two_pi / static_cast<float>(sides);
  const float angle = rotation + wedge * step;
  const Vec2 here{std::cos(angle), std::sin(angle)};
  const Vec2 next{std::cos(angle + step), std::sin(angle + step)};
  return here * to_this + next * to_next;
}
inline float regular_polygon_pdf(int sides) {
  const auto n = static_cast<float>(sides);
  return 2.0f / (n * std::sin(k_two_pi / n));
}

// Malley's method: the disk lifted onto the hemisphere.
inline Vec3 warp_cosine_hemisphere(Vec2 u) {
  const Vec2 disk = warp_concentric_disk(u);
  return {disk.x, disk.y, safe_sqrt(1.0f - dot(disk, disk))};
}
constexpr float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0.0f ? cos_theta * k_inv_pi : 0.0f;
}

// Directions within an angle of +z, given as 1 - cos of that angle so that narrow cones (the sun's)
// keep their precision. The disk is lifted onto the cap (Lambert's equal-area projection).
inline Vec3 warp_uniform_cone(Vec2 u, float one_minus_cos_max) {
  const Vec2 disk = warp_concentric_disk(u);
  const float height = dot(disk, disk) * one_minus_cos_max;  // 1 - cos(theta)
  const float scale = safe_sqrt(one_minus_cos_max * (2.0f - height));
  return {disk.x * scale, disk.y * scale, 1.0f - height};
}
constexpr float uniform_cone_pdf(float one_minus_cos_max) {
  return 0.5f * k_inv_pi / one_minus_cos_max;
}

inline Vec3 warp_uniform_hemisphere(Vec2 u) {
  return warp_uniform_cone(u, 1.0f);
}
constexpr float uniform_hemisphere_pdf() {
  return 0.5f * k_inv_pi;
}

inline Vec3 warp_uniform_sphere(Vec2 u) {
  return warp_uniform_cone(u, 2.0f);
}
constexpr float uniform_sphere_pdf() {
  return 0.25f * k_inv_pi;
}

// Barycentric weights, uniform over the area (Heitz 2019, "A Low-Distortion Map Between Triangle
// and Square").
constexpr std::array<float, 3> warp_triangle(Vec2 u) {
  float b0 = 0.5f * u.x, b1 = 0.5f * u.y;
  if (u.y > u.x)
    b1 = u.y - b0;
  else
    b0 = u.x - b1;
  return {b0, b1, std::max(0.0f, 1.0f - b0 - b1)};
}
constexpr float triangle_pdf(float area) {
  return 1.0f / area;
}

// Between values at (0, 0), (1, 0), (0, 1), (1, 1).
constexpr float bilinear(const std::array<float, 4>& corners, Vec2 at) {
  return lerp(lerp(corners[0], corners[1], at.x), lerp(corners[2], corners[3], at.x), at.y);
}

// The unit square with a density that is bilinear between its corners (values >= 0, not all 0),
// in the order of `bilinear`.
class BilinearSquare {
 public:
  explicit constexpr BilinearSquare(const std::array<float, 4>& corners) : c_(corners) {}
  Vec2 sample(Vec2 u) const {
    const float y = sample_linear(u.y, c_[0] + c_[1], c_[2] + c_[3]);
    return {sample_linear(u.x, lerp(c_[0], c_[2], y), lerp(c_[1], c_[3], y)), y};
  }
  constexpr float pdf(Vec2 at) const {
    return 4.0f * bilinear(c_, at) / (c_[0] + c_[1] + c_[2] + c_[3]);
  }

 private:
  // [0, 1] with a density that goes linearly from `a` to `b`, by inversion without cancellation.
  static float sample_linear(float u, float a, float b) {
    const float sum = a + b;
    return sum > 0.0f ? std::min(u * sum / (a + std::sqrt(lerp(a * a, b * b, u))), 1.0f) : u;
  }
  std::array<float, 4> c_;
};

// A rectangle seen from a point, sampled uniformly in solid angle (Urena et al. 2013, "An
// Area-Preserving Parametrization for Spherical Rectangles"). The angles of its corners are kept as
// their excess over a right angle: the sum has no 2 pi to cancel and holds for tiny rectangles.
class SphericalRectangle {
 public:
  // `corner` in the space of `from`; the edges as perpendicular unit axes and their lengths.
  SphericalRectangle(Vec3 from, Vec3 corner, Vec3 axis_x, Vec3 axis_y, float length_x,
                     float length_y)
      : from_(from), axis_x_(axis_x), axis_y_(axis_y) {
    axis_z_ = cross(axis_x_, axis_y_);
    const Vec3 d = corner - from;
    z0_ = dot(d, axis_z_);
    if (z0_ > 0.0f) {
      axis_z_ = -axis_z_;
      z0_ = -z0_;
    }
    x0_ = dot(d, axis_x_);
    y0_ = dot(d, axis_y_);
    x1_ = x0_ + length_x;
    y1_ = y0_ + length_y;
    if (!(z0_ < 0.0f)) return;  // seen edge-on, or not finite: no solid angle
    const auto slope = [this](float edge) { return edge / std::sqrt(edge * edge + z0_ * z0_); };
    // z components of the normals of the planes through the edges (their eq. 3).
    const float right = slope(x1_), left = -slope(x0_);
    b0_ = -slope(y0_);
    b1_ = slope(y1_);
    excess_ = fast_asin(b1_ * left) + fast_asin(left * b0_);
    solid_angle_ = std::max(0.0f, fast_asin(b0_ * right) + fast_asin(right * b1_) + excess_);
  }

  // 0: must not be sampled. Off by up to 1e-7: worthless for much smaller rectangles.
  float solid_angle() const { return solid_angle_; }
  float pdf() const { return 1.0f / solid_angle_; }

  // A point on the rectangle.
  Vec3 sample(Vec2 u) const {
    const float angle = excess_ - u.x * solid_angle_;  // pi minus their angle phi_u
    const float f = -(std::cos(angle) * b0_ + b1_) / std::sin(angle);
    const float c = std::copysign(1.0f, f) / std::sqrt(f * f + b0_ * b0_);
    // std::max(a, NaN) is a: the degenerate 0/0 lands on the edge x0.
    const float x = std::min(std::max(x0_, -c * z0_ / safe_sqrt(1.0f - c * c)), x1_);
    const float d2 = x * x + z0_ * z0_;
    const float h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const float h = h0 + u.y * (h1 - h0);
    const float y = std::clamp(h * std::sqrt(d2 / std::max(1.0f - h * h, 1e-12f)), y0_, y1_);
    return from_ + axis_x_ * x + axis_y_ * y + axis_z_ * z0_;
  }

 private:
  Vec3 from_, axis_x_, axis_y_, axis_z_;
  float x0_ = 0.0f, x1_ = 0.0f, y0_ = 0.0f, y1_ = 0.0f, z0_ = 0.0f;
  float b0_ = 0.0f, b1_ = 0.0f;
  float excess_ = 0.0f;
  float solid_angle_ = 0.0f;
};

}  // namespace tenniel
