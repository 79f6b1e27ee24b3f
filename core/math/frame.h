// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/numeric.h"
#include "math/vec.h"

namespace tenniel {

// Orthonormal right-handed basis; z is the normal of the surface it belongs to.
struct Frame {
  Vec3 x{1.0f, 0.0f, 0.0f}, y{0.0f, 1.0f, 0.0f}, z{0.0f, 0.0f, 1.0f};

  // Duff et al. 2017, "Building an Orthonormal Basis, Revisited". `normal` is unit length.
  static Frame from_normal(Vec3 normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1.0f + sign * sqr(normal.x) * a, sign * b, -sign * normal.x},
            {b, sign + sqr(normal.y) * a, -normal.y},
            normal};
  }

  // x lies along `tangent` projected off `normal`; any basis where the two are parallel.
  static Frame from_normal_tangent(Vec3 normal, Vec3 tangent) {
    const Vec3 projected = tangent - normal * dot(normal, tangent);
    if (!(length_squared(projected) > 1e-12f)) return from_normal(normal);
    const Vec3 x_axis = normalize(projected);
    return {x_axis, cross(normal, x_axis), normal};
  }

  Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

// Trigonometry of a unit direction in a local frame (z = normal).
inline float cos_theta(Vec3 w) {
  return w.z;
}
inline float abs_cos_theta(Vec3 w) {
  return std::abs(w.z);
}
inline float sin2_theta(Vec3 w) {
  return std::max(0.0f, 1.0f - sqr(w.z));
}
inline float tan2_theta(Vec3 w) {
  return sin2_theta(w) / sqr(w.z);
}
inline bool same_hemisphere(Vec3 a, Vec3 b) {
  return a.z * b.z > 0.0f;
}

}  // namespace tenniel
