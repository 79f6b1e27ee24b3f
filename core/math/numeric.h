// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tenniel {

constexpr float k_pi = 3.14159265358979323846f;
constexpr float k_two_pi = 2.0f * k_pi;
constexpr float k_inv_pi = 0.31830988618379067154f;
constexpr float k_one_minus_epsilon = 0x1.fffffep-1f;

constexpr float sqr(float x) {
  return x * x;
}
constexpr float lerp(float a, float b, float t) {
  return a * (1.0f - t) + b * t;
}
constexpr float saturate(float x) {
  return std::clamp(x, 0.0f, 1.0f);
}
// 3x^2 - 2x^3 on [0, 1].
constexpr float smoothstep(float x) {
  return x * x * (3.0f - 2.0f * x);
}
inline float fraction(float x) {
  return x - std::floor(x);
}
inline float safe_sqrt(float x) {
  return std::sqrt(std::max(x, 0.0f));
}
inline float safe_acos(float x) {
  return std::acos(std::clamp(x, -1.0f, 1.0f));
}
inline float safe_asin(float x) {
  return std::asin(std::clamp(x, -1.0f, 1.0f));
}
// asin to 2e-8 by a polynomial (Abramowitz & Stegun 1964, 4.4.46); clamps like `safe_asin`.
inline float fast_asin(float x) {
  const float a = std::min(std::abs(x), 1.0f);
  float p = -0.0012624911f;
  p = p * a + 0.0066700901f;
  p = p * a - 0.0170881256f;
  p = p * a + 0.0308918810f;
  p = p * a - 0.0501743046f;
  p = p * a + 0.0889789874f;
  p = p * a - 0.2145988016f;
  p = p * a + 1.5707963050f;
  return std::copysign(0.5f * k_pi - std::sqrt(1.0f - a) * p, x);
}
// sin and cos of x in [-pi/4, pi/4] to 1e-7 by polynomials (Moshier's Cephes, sinf.c).
inline float sin_near_zero(float x) {
  const float z = x * x;
  return ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * x + x;
}
inline float cos_near_zero(float x) {
  const float z = x * x;
  const float p = (2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f;
  return p * z * z - 0.5f * z + 1.0f;
}
// cos and sin of an angle in turns, to 1e-7.
struct CosSin {
  float cos, sin;
};
inline CosSin cos_sin_of_turns(float turns) {
  const float quarters = std::round(4.0f * turns);
  const float rest = (4.0f * turns - quarters) * (0.5f * k_pi);
  const float c = cos_near_zero(rest), s = sin_near_zero(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}
// atan2 to 3e-7 by a polynomial (Moshier's Cephes, atanf.c); 0 where both are 0.
inline float fast_atan2(float y, float x) {
  const float a = std::abs(x), b = std::abs(y);
  const float low = std::min(a, b), high = std::max(a, b);
  if (!(high > 0.0f)) return 0.0f;
  // Beyond tan(pi/8) the angle to pi/4 is the smaller one.
  const bool is_wide = low > 0.41421356f * high;
  const float t = is_wide ? (low - high) / (low + high) : low / high;
  const float z = t * t;
  float angle = ((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z;
  angle = (angle - 3.33329491539e-1f) * z * t + t + (is_wide ? 0.25f * k_pi : 0.0f);
  if (b > a) angle = 0.5f * k_pi - angle;
  if (x < 0.0f) angle = k_pi - angle;
  return std::copysign(angle, y);
}
// Zero where the divisor is zero: Blender's convention in every shader node.
constexpr float safe_divide(float a, float b) {
  return b != 0.0f ? a / b : 0.0f;
}
constexpr float pow5(float x) {
  return sqr(sqr(x)) * x;
}

inline uint32_t float_bits(float x) {
  return std::bit_cast<uint32_t>(x);
}
inline float bits_float(uint32_t x) {
  return std::bit_cast<float>(x);
}

}  // namespace tenniel
