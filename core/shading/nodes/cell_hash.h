// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/hash.h"
#include "math/spectrum.h"
#include "shading/nodes/noise.h"

// Random numbers of a point with float coordinates, each with Blender's own way to make several
// numbers from one hash.
namespace tenniel {

inline float random_of(const NoisePoint<1>& p) {
  return hash_float(p[0]);
}
inline float random_of(const NoisePoint<2>& p) {
  return hash_float(p[0], p[1]);
}
inline float random_of(const NoisePoint<3>& p) {
  return hash_float(p[0], p[1], p[2]);
}
inline float random_of(const NoisePoint<4>& p) {
  return hash_float(p[0], p[1], p[2], p[3]);
}

// `Float`: one number or lanes of them, each of another point.
template <class Float>
std::array<Float, 1> random_point_of(const std::array<Float, 1>& p) {
  return {hash_float(p[0])};
}
template <class Float>
std::array<Float, 2> random_point_of(const std::array<Float, 2>& p) {
  return {hash_float(p[0], p[1]), hash_float(p[0], p[1], Float{} + 1.0f)};
}
template <class Float>
std::array<Float, 3> random_point_of(const std::array<Float, 3>& p) {
  return {hash_float(p[0], p[1], p[2]), hash_float(p[0], p[1], p[2], Float{} + 1.0f),
          hash_float(p[0], p[1], p[2], Float{} + 2.0f)};
}
template <class Float>
std::array<Float, 4> random_point_of(const std::array<Float, 4>& p) {
  return {hash_float(p[0], p[1], p[2], p[3]), hash_float(p[3], p[0], p[1], p[2]),
          hash_float(p[2], p[3], p[0], p[1]), hash_float(p[1], p[2], p[3], p[0])};
}

inline Spectrum random_color_of(const NoisePoint<1>& p) {
  return {hash_float(p[0]), hash_float(p[0], 1.0f), hash_float(p[0], 2.0f)};
}
inline Spectrum random_color_of(const NoisePoint<2>& p) {
  return {hash_float(p[0], p[1]), hash_float(p[0], p[1], 1.0f), hash_float(p[0], p[1], 2.0f)};
}
inline Spectrum random_color_of(const NoisePoint<3>& p) {
  const NoisePoint<3> r = random_point_of(p);
  return {r[0], r[1], r[2]};
}
inline Spectrum random_color_of(const NoisePoint<4>& p) {
  return {hash_float(p[0], p[1], p[2], p[3]), hash_float(p[2], p[0], p[3], p[1]),
          hash_float(p[3], p[2], p[1], p[0])};
}

}  // namespace tenniel
