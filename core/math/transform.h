// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "math/vec.h"

namespace tenniel {

// Affine map: the upper 3x4 of a matrix that acts on columns, as Blender's `Matrix`.
struct Transform {
  Vec3 x{1.0f, 0.0f, 0.0f}, y{0.0f, 1.0f, 0.0f}, z{0.0f, 0.0f, 1.0f};  // columns
  Vec3 translation;

  // `m`: 12 floats, three rows of four, row-major.
  static constexpr Transform from_rows(const std::array<float, 12>& m) {
    return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
  }

  constexpr Vec3 point(Vec3 p) const { return vector(p) + translation; }
  constexpr Vec3 vector(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  // With `this` the *inverse* of the map that carries points: n_world = inverse^T n_object.
  // The result is not unit length.
  constexpr Vec3 transposed_vector(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  constexpr float determinant() const { return dot(x, cross(y, z)); }

  // Inverse in double precision; a singular map (an object scaled to 0) gives the zero map.
  Transform inverse() const;
};

constexpr Transform operator*(const Transform& a, const Transform& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.translation)};
}

constexpr bool operator==(const Transform& a, const Transform& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.translation == b.translation;
}

constexpr Transform lerp(const Transform& a, const Transform& b, float t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t,
          a.translation + (b.translation - a.translation) * t};
}

// Where something is during the shutter: at `steps`, which are equally far apart in time, and
// between them on a straight line, as Embree has it. Two steps at least.
inline Transform place_at(const std::vector<Transform>& steps, float time) {
  const float position = std::clamp(time, 0.0f, 1.0f) * static_cast<float>(steps.size() - 1);
  const size_t first = std::min(static_cast<size_t>(position), steps.size() - 2);
  return lerp(steps[first], steps[first + 1], position - static_cast<float>(first));
}

inline bool is_finite(const Transform& t) {
  return is_finite(t.x) && is_finite(t.y) && is_finite(t.z) && is_finite(t.translation);
}

inline Transform Transform::inverse() const {
  struct D3 {
    double x, y, z;
  };
  const auto wide = [](Vec3 v) { return D3{v.x, v.y, v.z}; };
  const auto cross_d = [](D3 a, D3 b) {
    return D3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const D3 a = wide(x), b = wide(y), c = wide(z), t = wide(translation);
  const D3 bc = cross_d(b, c), ca = cross_d(c, a), ab = cross_d(a, b);
  const double det = a.x * bc.x + a.y * bc.y + a.z * bc.z;
  if (det == 0.0 || !std::isfinite(det)) return {{}, {}, {}, {}};
  const double s = 1.0 / det;
  const auto row_dot = [&](D3 row) { return -(row.x * t.x + row.y * t.y + row.z * t.z) * s; };
  const auto narrow = [s](double p, double q, double r) {
    return Vec3{static_cast<float>(p * s), static_cast<float>(q * s), static_cast<float>(r * s)};
  };
  return {narrow(bc.x, ca.x, ab.x), narrow(bc.y, ca.y, ab.y), narrow(bc.z, ca.z, ab.z),
          Vec3{static_cast<float>(row_dot(bc)), static_cast<float>(row_dot(ca)),
               static_cast<float>(row_dot(ab))}};
}

}  // namespace tenniel
