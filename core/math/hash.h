// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/lanes.h"
#include "math/numeric.h"

// Bob Jenkins' lookup3 `final` mixing over 1 to 4 words: the hash behind Blender's procedural
// textures, which must agree with it bit by bit.
namespace tenniel {

namespace detail {
// The arithmetic below works on one word or, lane by lane, on a vector of them.
template <class U>
constexpr U rotate_left(U x, int k) {
  return x << k | x >> (32 - k);
}

template <class U>
constexpr U jenkins_final(U a, U b, U c) {
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

template <class U>
constexpr U hash_uint(U x) {
  const U s = U{} + detail::jenkins_seed(1);
  return detail::jenkins_final(s + x, s, s);
}
template <class U>
constexpr U hash_uint(U x, std::type_identity_t<U> y) {
  const U s = U{} + detail::jenkins_seed(2);
  return detail::jenkins_final(s + x, s + y, s);
}
template <class U>
constexpr U hash_uint(U x, std::type_identity_t<U> y, std::type_identity_t<U> z) {
  const U s = U{} + detail::jenkins_seed(3);
  return detail::jenkins_final(s + x, s + y, s + z);
}
template <class U>
constexpr U hash_uint(U x, std::type_identity_t<U> y, std::type_identity_t<U> z,
                      std::type_identity_t<U> w) {
  const U s = U{} + detail::jenkins_seed(4);
  U a = s + x, b = s + y, c = s + z;
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
inline FloatLanes uint_to_unit_closed(UintLanes h) {
  return __builtin_convertvector(h, FloatLanes) * (1.0f / 4294967295.0f);
}
// [0, 1): 24 bits.
constexpr float uint_to_unit(uint32_t h) {
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

// Of floats or of lanes of them.
template <class Float, class... Floats>
Float hash_float(Float first, Floats... k) {
  return uint_to_unit_closed(hash_uint(float_bits(first), float_bits(k)...));
}

}  // namespace tenniel
