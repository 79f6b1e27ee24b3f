// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "math/vec.h"

namespace tenniel {

enum class GridFilter : uint8_t { linear, closest, cubic };

// Values on a regular grid that fills the unit cube, x fastest; outside there is nothing.
class VoxelGrid {
 public:
  using Values = std::vector<float>;
  using Rgba = std::array<float, 4>;

  // `values` holds resolution.x * y * z times `channels` (1, 3 or 4) floats; what is not a finite
  // number becomes 0.
  VoxelGrid(std::shared_ptr<Values> values, std::array<int, 3> resolution, int channels);

  // One number is spread over the three colours; a missing alpha is 1.
  Rgba lookup(Vec3 p, GridFilter filter) const;

  const std::array<int, 3>& resolution() const { return resolution_; }
  size_t memory_bytes() const { return values_->size() * sizeof(float); }

 private:
  // Which voxels of one axis count, and how much.
  struct Taps {
    std::array<int, 4> voxels{};
    std::array<float, 4> weights{};
    size_t count = 1;
  };
  static Taps taps(float x, int size, GridFilter filter);

  std::shared_ptr<const Values> values_;
  std::array<int, 3> resolution_;
  size_t channels_;
};

}  // namespace tenniel
