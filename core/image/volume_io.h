// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "image/voxel_grid.h"
#include "math/cancellation.h"
#include "math/transform.h"

namespace tenniel {

// No grid of more bytes in memory, or of more bricks, is read.
constexpr size_t k_max_grid_bytes = size_t{8} << 30;
constexpr size_t k_max_grid_bricks = size_t{1} << 24;

struct VolumeLoadResult {
  std::unique_ptr<const VoxelGrid> grid;  // null when `error` is set
  Transform to_unit;                      // from the space of the file to the grid's unit cube
  std::string error;                      // one sentence that names file and grid
};

// Reads one grid of floats, doubles or vectors of an OpenVDB file. The first voxel of a cell has
// its value in the middle of the cell, as in Cycles. Throws Cancelled, and nothing else.
VolumeLoadResult load_volume(const std::string& path, const std::string& grid,
                             const Cancellation& cancellation);

}  // namespace tenniel
