// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "math/hash.h"
#include "math/vec.h"

namespace tenniel {

namespace detail {
// The arithmetic below works on one number or, lane by lane, on eight for each vertex.
template <size_t vertices>
using Lanes [[gnu::vector_size(vertices * 32)]] = uint32_t;

template <class U>
constexpr U reverse_bits(U x) {
  x = (x & 0x0000ffffu) << 16 | x >> 16;
  x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

// Owen scrambling of a bit-reversed number: every bit is flipped by a hash of the bits below it
// (Laine & Karras 2011, eq. 12, with the constants of Vegdahl 2021, "Building a Better LK Hash").
template <class U>
constexpr U permute_reversed(U x, U seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= seed >> 16 | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Second Sobol dimension, bit-reversed: the Pascal matrix modulo 2 times the index, factored into
// the powers of two (Ahmed 2024, "An Implementation Algorithm of 2D Sobol Sequence"). The first
// dimension, bit-reversed, is the index itself.
template <class U>
constexpr U reversed_sobol_1(U index) {
  index ^= index >> 16;
  index ^= (index & 0xff00ff00u) >> 8;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xccccccccu) >> 2;
  return index ^ (index & 0xaaaaaaaau) >> 1;
}

constexpr uint32_t k_salt_x = 0x3c6ef372u, k_salt_y = 0xa54ff53au;
}  // namespace detail

// What one path vertex draws, made at once: the lanes of a vector hide each other's latency.
struct VertexNumbers {
  float light;     // request 0
  Vec2 on_light;   // request 1
  float flight;    // request 2
  Vec2 wi;         // request 3
  float roulette;  // request 4
  static constexpr uint32_t k_requests = 5;
};

// Owen-scrambled Sobol points, padded: each request takes the first one or two Sobol dimensions
// with its own shuffle of the sample index and its own scramble (Burley 2020, "Practical Hash-based
// Owen Scrambling"). The numbers depend on (seed, pixel, sample index, dimension) and on nothing
// else.
class Sampler {
 public:
  explicit Sampler(uint32_t seed) : seed_(mix_bits(seed ^ 0x9e3779b9u)) {}

  void start_sample(int x, int y, uint32_t index) {
    pixel_ = mix_bits(static_cast<uint32_t>(x) ^ mix_bits(static_cast<uint32_t>(y) ^ seed_));
    dimension_ = 0;
    set_index(index);
  }
  // Another sample of the same pixel; the dimension stays.
  void set_index(uint32_t index) { reversed_index_ = detail::reverse_bits(index); }
  // Requests from here on take dimensions from `dimension` up, one each, be it of one number or
  // two: one fixed block a path vertex, so that what one vertex draws never shifts the numbers of
  // the next.
  void set_dimension(uint32_t dimension) { dimension_ = dimension; }

  // [0, 1)
  float get_1d() {
    const uint32_t seed = next_seed();
    return scrambled(shuffled_index(seed), mix_bits(seed ^ detail::k_salt_x));
  }
  // [0, 1)^2
  Vec2 get_2d() {
    const uint32_t seed = next_seed();
    const uint32_t index = shuffled_index(seed);
    return {scrambled(index, mix_bits(seed ^ detail::k_salt_x)),
            scrambled(detail::reversed_sobol_1(index), mix_bits(seed ^ detail::k_salt_y))};
  }
  // The same numbers as that many requests from `dimension` on, which stand one after the other.
  VertexNumbers vertex_numbers(uint32_t dimension) const { return numbers_of<1>(dimension, 0)[0]; }
  // And those of the vertex whose block begins `stride` dimensions further: both take little longer
  // than one.
  std::array<VertexNumbers, 2> numbers_of_two_vertices(uint32_t dimension, uint32_t stride) const {
    return numbers_of<2>(dimension, stride);
  }

 private:
  template <size_t vertices>
  std::array<VertexNumbers, vertices> numbers_of(uint32_t dimension, uint32_t stride) const;
  uint32_t next_seed() { return mix_bits(pixel_ + dimension_++ * 0x9e3779b9u); }
  // Every aligned block of 2^k indices stays one block, so nets stay nets.
  uint32_t shuffled_index(uint32_t seed) const {
    return detail::reverse_bits(detail::permute_reversed(reversed_index_, seed));
  }
  static float scrambled(uint32_t reversed_digits, uint32_t seed) {
    return uint_to_unit(detail::reverse_bits(detail::permute_reversed(reversed_digits, seed)));
  }

  uint32_t seed_;
  uint32_t pixel_ = 0;
  uint32_t reversed_index_ = 0;
  uint32_t dimension_ = 0;
};

template <size_t vertices>
std::array<VertexNumbers, vertices> Sampler::numbers_of(uint32_t dimension, uint32_t stride) const {
  using Lanes = detail::Lanes<vertices>;
  // Of the eight lanes of a vertex; the last one is idle.
  constexpr std::array<uint32_t, 8> k_request = {0, 1, 1, 2, 3, 3, 4, 4};
  constexpr std::array<uint32_t, 8> k_takes_y = {0, 0, ~0u, 0, 0, ~0u, 0, 0};
  Lanes request, takes_y;
  for (size_t i = 0; i < 8 * vertices; ++i) {
    request[i] = dimension + k_request[i % 8] + (i < 8 ? 0 : stride);
    takes_y[i] = k_takes_y[i % 8];
  }
  const Lanes salt = detail::k_salt_x ^ (takes_y & (detail::k_salt_x ^ detail::k_salt_y));
  const Lanes seed = mix_bits(Lanes(pixel_ + request * 0x9e3779b9u));
  const Lanes index =
      detail::reverse_bits(detail::permute_reversed(Lanes(reversed_index_ + Lanes{}), seed));
  const Lanes digits = (index & ~takes_y) | (detail::reversed_sobol_1(index) & takes_y);
  const Lanes bits =
      detail::reverse_bits(detail::permute_reversed(digits, mix_bits(Lanes(seed ^ salt))));
  std::array<float, 8 * vertices> u;
  for (size_t i = 0; i < u.size(); ++i)
    u[i] = uint_to_unit(bits[i]);
  std::array<VertexNumbers, vertices> numbers;
  for (size_t v = 0; v < vertices; ++v) {
    const float* of = &u[8 * v];
    numbers[v] = {of[0], {of[1], of[2]}, of[3], {of[4], of[5]}, of[6]};
  }
  return numbers;
}

// Plain generator (PCG32, O'Neill 2014) for loops of unknown length; seed it from one dimension.
class LocalRandom {
 public:
  explicit LocalRandom(uint32_t seed)
      : state_((static_cast<uint64_t>(mix_bits(seed)) << 32) | mix_bits(seed + 0x68bc21ebu)) {
    next();
  }
  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    return std::rotr(shifted, static_cast<int>(old >> 59));
  }
  float get_1d() { return uint_to_unit(next()); }
  Vec2 get_2d() {
    const float x = get_1d();
    return {x, get_1d()};
  }

 private:
  uint64_t state_;
};

}  // namespace tenniel
