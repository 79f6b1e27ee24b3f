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

inline NoisePoint<1> random_point_of(const NoisePoint<1>& p) {
  return {random_of(p)};
}
inline NoisePoint<2> random_point_of(const NoisePoint<2>& p) {
  return {hash_float(p[0], p[1]), hash_float(p[0], p[1], 1.0f)};
}
inline NoisePoint<3> random_point_of(const NoisePoint<3>& p) {
  return {hash_float(p[0], p[1], p[2]), hash_float(p[0], p[1], p[2], 1.0f),
          hash_float(p[0], p[1], p[2], 2.0f)};
}
inline NoisePoint<4> random_point_of(const NoisePoint<4>& p) {
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
