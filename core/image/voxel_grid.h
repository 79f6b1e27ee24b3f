// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "image/empty_blocks.h"
#include "math/cancellation.h"
#include "math/vec.h"

namespace tenniel {

enum class GridFilter : uint8_t { linear, closest, cubic };
// What a filter finds beyond the outermost voxels.
enum class GridBorder : uint8_t { extended, empty };

// Values on a regular grid that fills the unit cube, x fastest; further out there is nothing. Kept
// in bricks, so that empty space costs a pointer each 512 voxels; each repeats the first voxels of
// the next ones, so that a linear lookup finds all it needs in one.
class VoxelGrid {
 public:
  using Rgba = std::array<float, 4>;
  static constexpr int k_brick_side = 8;
  static constexpr size_t k_brick_voxels = k_brick_side * k_brick_side * k_brick_side;

  // Empty. `channels`: 1, 3 or 4 floats a voxel.
  VoxelGrid(std::array<int, 3> resolution, int channels, GridBorder border);
  // `values` holds resolution.x * y * z times `channels` floats; the border is extended.
  VoxelGrid(const std::vector<float>& values, std::array<int, 3> resolution, int channels);

  // For each brick that is not empty, before `finish`: fills it, counted from the first voxel.
  // `values`: 8 x 8 x 8 voxels, x fastest; what is not a finite number becomes 0.
  void set_brick(std::array<int, 3> brick, const float* values);

  // One number is spread over the three colours; a missing alpha is 1.
  Rgba lookup(Vec3 p, GridFilter filter) const;

  // To be called once after all bricks are filled and before any lookup.
  void finish(const Cancellation& cancellation = {});
  // In the space of the unit cube: for all 0 <= t < the result, linear lookups at p + t * direction
  // are 0. A lower bound; 0 near voxels that are not, and where the border is extended.
  float empty_until(Vec3 p, Vec3 direction) const;

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
  const float* find_cell(Vec3 place, std::array<float, 3>& fractions) const;
  void repeat_next_bricks(std::array<size_t, 3> brick);
  float value_near(std::array<size_t, 3> voxel, size_t channel) const;
  bool is_block_filled(std::array<size_t, 3> block) const;
  Rgba gather(const Taps& x, const Taps& y, const Taps& z) const;
  bool reaches(Vec3 p) const;
  Vec3 in_voxels(Vec3 v) const;

  std::array<int, 3> resolution_;
  std::array<size_t, 3> brick_strides_;  // of an axis in `table_`
  size_t channels_;
  GridBorder border_;
  std::vector<std::unique_ptr<float[]>> bricks_;  // the first is empty space
  std::vector<float*> table_;                     // brick by brick, x fastest
  EmptyBlocks empty_blocks_;
};

}  // namespace tenniel
