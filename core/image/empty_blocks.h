// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "math/cancellation.h"
#include "math/vec.h"

namespace tenniel {

// Says of a grid of voxels how far a ray may go without meeting any that linear lookups would find
// to be more than 0: of each block of 4 x 4 x 4 it keeps how far the nearest filled one is.
class EmptyBlocks {
 public:
  static constexpr int k_side = 4;  // voxels

  EmptyBlocks() = default;  // of a grid without voxels: all is empty
  // `is_filled` is asked once of each block, by its place among the blocks. Throws Cancelled.
  EmptyBlocks(std::array<int, 3> voxels,
              const std::function<bool(std::array<size_t, 3>)>& is_filled,
              const Cancellation& cancellation);

  // In voxels: all linear lookups at from + t * step are 0 for 0 <= t < the result. A lower bound;
  // 0 near filled blocks.
  float until(Vec3 from, Vec3 step) const;

  size_t memory_bytes() const { return distances_.size(); }

 private:
  void spread_along(size_t axis, const Cancellation& cancellation);

  std::array<int, 3> voxels_{};
  std::array<size_t, 3> counts_{}, strides_{};  // of blocks along each axis
  // In blocks, along the axis where they are farthest apart (Chebyshev's distance).
  std::vector<uint8_t> distances_;
};

}  // namespace tenniel
