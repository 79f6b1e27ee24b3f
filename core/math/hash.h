// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "math/numeric.h"

// Bob Jenkins' lookup3 `final` mixing over 1 to 4 words: the hash behind Blender's procedural
// textures, which must agree with it bit by bit.
namespace tenniel {

namespace detail {
constexpr uint32_t rotate_left(uint32_t x, int k) {
  return std::rotl(x, k);
}

constexpr uint32_t jenkins_final(uint32_t a, uint32_t b, uint32_t c) {
  c = (c ^ b) - rotate_left(b, 14);
  a = (a ^ c) - rotate_left(c, 11);
  b = (b ^ a) - rotate_left(a, 25);
  c = (c ^ b) - rotate_left(b, 16);
  a = (a ^ c) - rotate_left(c, 4);
  b = (b ^ a) - rotate_left(a, 14);
  c = (c ^ b) - rotate_left(b, 24);
  return c;
}

constexpr uint32_t jenkins_seed(uint32_t n) {
  return 0xdeadbeefu + (n << 2) + 13u;
}
}  // namespace detail

constexpr uint32_t hash_uint(uint32_t x) {
  const uint32_t s = detail::jenkins_seed(1);
  return detail::jenkins_final(s + x, s, s);
}
constexpr uint32_t hash_uint(uint32_t x, uint32_t y) {
  const uint32_t s = detail::jenkins_seed(2);
  return detail::jenkins_final(s + x, s + y, s);
}
constexpr uint32_t hash_uint(uint32_t x, uint32_t y, uint32_t z) {
  const uint32_t s = detail::jenkins_seed(3);
  return detail::jenkins_final(s + x, s + y, s + z);
}
constexpr uint32_t hash_uint(uint32_t x, uint32_t y, uint32_t z, uint32_t w) {
  const uint32_t s = detail::jenkins_seed(4);
  uint32_t a = s + x, b = s + y, c = s + z;
  a = (a - c) ^ detail::rotate_left(c, 4);
  c += b;
  b = (b - a) ^ detail::rotate_left(a, 6);
  a += c;
  c = (c - b) ^ detail::rotate_left(b, 8);
  b += a;
  a = (a - c) ^ detail::rotate_left(c, 16);
  c += b;
  b = (b - a) ^ detail::rotate_left(a, 19);
  a += c;
  c = (c - b) ^ detail::rotate_left(b, 4);
  b += a;
  return detail::jenkins_final(a + w, b, c);
}

// A full 32-bit avalanche (Chris Wellons' lowbias32), for seeds of random streams; of one word or
// of a vector of them.
template <class U>
constexpr U mix_bits(U x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

// [0, 1], both ends reachable: Blender's float of a hash.
constexpr float uint_to_unit_closed(uint32_t h) {
  return static_cast<float>(h) * (1.0f / 4294967295.0f);
}
// [0, 1): 24 bits.
constexpr float uint_to_unit(uint32_t h) {
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

template <class... Floats>
float hash_float(Floats... k) {
  return uint_to_unit_closed(hash_uint(float_bits(k)...));
}

}  // namespace tenniel
