// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Eight numbers that are worked on side by side: vectors of GCC, which become what registers the
// machine has. A comparison gives all bits of a lane or none; `mask ? a : b` chooses lane by lane.
namespace tenniel {

constexpr size_t k_lanes = 8;
using FloatLanes = float __attribute__((vector_size(k_lanes * sizeof(float))));
using UintLanes = uint32_t __attribute__((vector_size(k_lanes * sizeof(uint32_t))));

inline FloatLanes load_lanes(const float* from) {
  FloatLanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void store_lanes(FloatLanes lanes, float* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

inline UintLanes float_bits(FloatLanes x) {
  return std::bit_cast<UintLanes>(x);
}

// Calls `f` for the number in each lane.
template <class Function>
FloatLanes each_lane(FloatLanes x, Function f) {
  for (size_t i = 0; i < k_lanes; ++i)
    x[i] = f(x[i]);
  return x;
}

inline float smallest(FloatLanes x) {
  float least = x[0];
  for (size_t i = 1; i < k_lanes; ++i)
    least = std::min(least, x[i]);
  return least;
}

}  // namespace tenniel
