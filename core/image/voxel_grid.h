// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "math/vec.h"

namespace tenniel {

enum class GridFilter : uint8_t { linear, closest, cubic };
// What a filter finds beyond the outermost voxels.
enum class GridBorder : uint8_t { extended, empty };

// Values on a regular grid that fills the unit cube, x fastest; further out there is nothing. Kept
// in bricks, so that empty space costs a pointer each 512 voxels.
class VoxelGrid {
 public:
  using Rgba = std::array<float, 4>;
  static constexpr int k_brick_side = 8;
  static constexpr size_t k_brick_voxels = k_brick_side * k_brick_side * k_brick_side;

  // Empty. `channels`: 1, 3 or 4 floats a voxel.
  VoxelGrid(std::array<int, 3> resolution, int channels, GridBorder border);
  // `values` holds resolution.x * y * z times `channels` floats; the border is extended.
  VoxelGrid(const std::vector<float>& values, std::array<int, 3> resolution, int channels);

  // Fills a brick, counted from the first voxel. `values`: 8 x 8 x 8 voxels, x fastest; what is not
  // a finite number becomes 0.
  void set_brick(std::array<int, 3> brick, const float* values);

  // One number is spread over the three colours; a missing alpha is 1.
  Rgba lookup(Vec3 p, GridFilter filter) const;

  const std::array<int, 3>& resolution() const { return resolution_; }
  size_t memory_bytes() const;

 private:
  // Which voxels of one axis count, and how much: what each adds to the index of the brick and to
  // that within the brick.
  struct Taps {
    std::array<size_t, 4> bricks{}, voxels{};
    std::array<float, 4> weights{};
    size_t count = 0;
  };
  Taps taps(float x, size_t axis, GridFilter filter) const;
  bool reaches(Vec3 p) const;

  std::array<int, 3> resolution_;
  std::array<size_t, 3> brick_strides_;  // of an axis in `table_`
  size_t channels_;
  GridBorder border_;
  std::vector<std::unique_ptr<float[]>> bricks_;  // the first is empty space
  std::vector<const float*> table_;               // brick by brick, x fastest
};

}  // namespace tenniel
