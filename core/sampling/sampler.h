// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "math/hash.h"
#include "math/vec.h"

namespace tenniel {

// Owen-scrambled Sobol points, padded: each request takes the first one or two Sobol dimensions with
// its own shuffle of the sample index and its own scramble (Burley 2020, "Practical Hash-based Owen
// Scrambling"). The numbers depend on (seed, pixel, sample index, dimension) and on nothing else.
class Sampler {
 public:
  explicit Sampler(uint32_t seed) : seed_(mix_bits(seed ^ 0x9e3779b9u)) {}

  void start_sample(int x, int y, uint32_t index);
  // Requests from here on take dimensions from `dimension` up: one fixed block a path vertex, so
  // that what one vertex draws never shifts the numbers of the next.
  void set_dimension(uint32_t dimension) { dimension_ = dimension; }

  float get_1d();  // [0, 1)
  Vec2 get_2d();   // [0, 1)^2

 private:
  uint32_t seed_;
  uint32_t pixel_ = 0;
  uint32_t index_ = 0;
  uint32_t dimension_ = 0;
};

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
