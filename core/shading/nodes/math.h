// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfloat>
#include <cmath>
#include <cstdint>

#include "math/numeric.h"

// The arithmetic of the Math, Clamp and Map Range nodes, with Blender's conventions: what has no
// value (a division by zero, the logarithm of nothing) is 0.
namespace tenniel {

enum class MathOperation : uint8_t {
  add,
  subtract,
  multiply,
  divide,
  multiply_add,
  power,
  logarithm,
  sqrt,
  inverse_sqrt,
  absolute,
  exponent,
  minimum,
  maximum,
  less_than,
  greater_than,
  sign,
  compare,
  smooth_min,
  smooth_max,
  round,
  floor,
  ceil,
  trunc,
  fract,
  modulo,
  wrap,
  snap,
  pingpong,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  arctan2,
  sinh,
  cosh,
  tanh,
  radians,
  degrees,
};

inline float safe_power(float base, float exponent) {
  if (base < 0.0f && exponent != std::floor(exponent)) return 0.0f;
  return std::pow(base, exponent);
}

inline float safe_logarithm(float x, float base) {
  return x > 0.0f && base > 0.0f ? safe_divide(std::log(x), std::log(base)) : 0.0f;
}

inline float safe_modulo(float x, float divisor) {
  return divisor != 0.0f ? std::fmod(x, divisor) : 0.0f;
}

inline float wrap(float x, float upper, float lower) {
  const float range = upper - lower;
  return range != 0.0f ? x - range * std::floor((x - lower) / range) : lower;
}

inline float snap(float x, float step) {
  return std::floor(safe_divide(x, step)) * step;
}

inline float pingpong(float x, float scale) {
  if (scale == 0.0f) return 0.0f;
  return std::abs(fraction((x - scale) / (scale * 2.0f)) * scale * 2.0f - scale);
}

// Minimum whose corner is rounded over the width `k` (Quilez, cubic variant).
inline float smooth_minimum(float a, float b, float k) {
  if (k == 0.0f) return std::min(a, b);
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * h * k * (1.0f / 6.0f);
}

float math_operation(MathOperation operation, float a, float b, float c);

inline float clamp_minmax(float x, float low, float high) {
  return std::min(std::max(x, low), high);
}
inline float clamp_range(float x, float a, float b) {
  return clamp_minmax(x, std::min(a, b), std::max(a, b));
}

enum class MapRangeShape : uint8_t { linear, stepped, smoothstep, smootherstep };

// Where a position in the source range (0 = its start, 1 = its end) comes to lie in the target.
float shape_range(MapRangeShape shape, float position, float steps);

}  // namespace tenniel
