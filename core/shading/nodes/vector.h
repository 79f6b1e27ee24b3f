// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

enum class VectorOperation : uint8_t {
  add,
  subtract,
  multiply,
  divide,
  multiply_add,
  cross_product,
  project,
  reflect,
  refract,
  faceforward,
  dot_product,
  distance,
  length,
  scale,
  normalize,
  absolute,
  minimum,
  maximum,
  floor,
  ceil,
  fraction,
  modulo,
  wrap,
  snap,
  sine,
  cosine,
  tangent,
};

// Applies `f` to each component.
template <class Function, class... Vectors>
Vec3 by_component(Function f, Vectors... v) {
  return {f(v.x...), f(v.y...), f(v.z...)};
}

// The operations with a vector as result; `scale` is the Scale socket (eta for refract).
Vec3 vector_operation(VectorOperation operation, Vec3 a, Vec3 b, Vec3 c, float scale);
// Those with a number as result (dot product, distance, length); 0 for all others.
float vector_measure(VectorOperation operation, Vec3 a, Vec3 b);

// Rotation by Euler angles in radians, about x first and z last: R = Rz Ry Rx.
Transform euler_rotation(Vec3 angles);
// The rotation's inverse.
constexpr Transform transposed(const Transform& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}, {}};
}

}  // namespace tenniel
