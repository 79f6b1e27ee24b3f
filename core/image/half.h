// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__F16C__)
#include <immintrin.h>
#endif

// IEEE 754 binary16, as stored in OpenEXR files.
namespace tenniel {

#if defined(__F16C__)

inline float half_to_float(uint16_t h) {
  return _cvtsh_ss(h);
}
// Rounds to nearest even; beyond 65504 becomes infinite.
inline uint16_t float_to_half(float x) {
  return static_cast<uint16_t>(
      _mm_cvtsi128_si32(_mm_cvtps_ph(_mm_set_ss(x), _MM_FROUND_TO_NEAREST_INT)));
}

#else

inline float half_to_float(uint16_t h) {
  const uint32_t sign = static_cast<uint32_t>(h & 0x8000u) << 16;
  const uint32_t magnitude = h & 0x7fffu;
  if (magnitude >= 0x7c00u)  // infinite or NaN
    return std::bit_cast<float>(sign | 0x7f800000u | (magnitude & 0x3ffu) << 13);
  if (magnitude >= 0x0400u) return std::bit_cast<float>(sign | ((magnitude << 13) + 0x38000000u));
  const float denormal = static_cast<float>(magnitude) * 0x1p-24f;
  return sign ? -denormal : denormal;
}

// Rounds to nearest even; beyond 65504 becomes infinite.
inline uint16_t float_to_half(float x) {
  const uint32_t bits = std::bit_cast<uint32_t>(x);
  const uint32_t sign = bits >> 16 & 0x8000u;
  const uint32_t magnitude = bits & 0x7fffffffu;
  uint32_t half;
  if (magnitude > 0x7f800000u) {
    half = 0x7e00u;  // NaN
  } else if (magnitude >= 0x477ff000u) {
    half = 0x7c00u;
  } else if (magnitude < 0x38800000u) {
    // Adding 0.5 moves the bits of a denormal half to the end of the mantissa, rounded.
    half = std::bit_cast<uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
  } else {
    half = (magnitude - 0x38000000u + 0xfffu + (magnitude >> 13 & 1u)) >> 13;
  }
  return static_cast<uint16_t>(sign | half);
}

#endif

// Rounds toward zero, as Cycles stores the images that it converts: their texels agree to the bit.
inline uint16_t float_to_half_toward_zero(float x) {
  const uint16_t nearest = float_to_half(x);
  const bool is_too_far = std::abs(half_to_float(nearest)) > std::abs(x);
  return is_too_far ? static_cast<uint16_t>(nearest - 1) : nearest;
}

}  // namespace tenniel
