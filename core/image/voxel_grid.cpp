// SPDX-License-Identifier: Apache-2.0
#include "image/voxel_grid.h"

#include <algorithm>
#include <cmath>

namespace tenniel {

namespace {

constexpr int k_side = VoxelGrid::k_brick_side;

size_t bricks_along(int voxels) {
  return static_cast<size_t>((voxels + k_side - 1) / k_side);
}

}  // namespace

VoxelGrid::VoxelGrid(std::array<int, 3> resolution, int channels, GridBorder border)
    : resolution_(resolution), channels_(static_cast<size_t>(channels)), border_(border) {
  const size_t x = bricks_along(resolution[0]), y = bricks_along(resolution[1]);
  brick_strides_ = {1, x, x * y};
  bricks_.push_back(std::make_unique<float[]>(k_brick_voxels * channels_));
  table_.assign(x * y * bricks_along(resolution[2]), bricks_.front().get());
}

VoxelGrid::VoxelGrid(const std::vector<float>& values, std::array<int, 3> resolution, int channels)
    : VoxelGrid(resolution, channels, GridBorder::extended) {
  const auto row_of = [&](int y, int z) {
    return (static_cast<size_t>(z) * static_cast<size_t>(resolution[1]) + static_cast<size_t>(y)) *
           static_cast<size_t>(resolution[0]);
  };
  std::vector<float> brick(k_brick_voxels * channels_);
  for (int z = 0; z < resolution[2]; z += k_side)
    for (int y = 0; y < resolution[1]; y += k_side)
      for (int x = 0; x < resolution[0]; x += k_side) {
        const auto width = static_cast<size_t>(std::min(k_side, resolution[0] - x)) * channels_;
        for (int k = 0; k < std::min(k_side, resolution[2] - z); ++k)
          for (int j = 0; j < std::min(k_side, resolution[1] - y); ++j)
            std::copy_n(&values[(row_of(y + j, z + k) + static_cast<size_t>(x)) * channels_], width,
                        &brick[static_cast<size_t>((k * k_side + j) * k_side) * channels_]);
        set_brick({x / k_side, y / k_side, z / k_side}, brick.data());
      }
}

void VoxelGrid::set_brick(std::array<int, 3> brick, const float* values) {
  const size_t count = k_brick_voxels * channels_;
  const auto usable = [](float v) { return std::isfinite(v) ? v : 0.0f; };
  if (std::none_of(values, values + count, [&](float v) { return usable(v) != 0.0f; })) return;
  const auto& made = bricks_.emplace_back(std::make_unique<float[]>(count));
  std::transform(values, values + count, made.get(), usable);
  size_t index = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    index += static_cast<size_t>(brick[axis]) * brick_strides_[axis];
  table_[index] = made.get();
}

size_t VoxelGrid::memory_bytes() const {
  return bricks_.size() * k_brick_voxels * channels_ * sizeof(float) +
         table_.size() * sizeof(table_[0]);
}

// Voxels have their values in their middle.
VoxelGrid::Taps VoxelGrid::taps(float x, size_t axis, GridFilter filter) const {
  constexpr std::array<size_t, 3> k_voxel_strides{1, k_side, k_side * k_side};
  Taps taps;
  const int size = resolution_[axis];
  const auto add = [&](int voxel, float weight) {
    const int inside = std::clamp(voxel, 0, size - 1);
    const auto i = static_cast<size_t>(inside);
    taps.bricks[taps.count] = i / k_side * brick_strides_[axis];
    taps.voxels[taps.count] = i % k_side * k_voxel_strides[axis] * channels_;
    taps.weights[taps.count++] = border_ == GridBorder::extended || inside == voxel ? weight : 0.0f;
  };
  const float place = x * static_cast<float>(size);
  if (filter == GridFilter::closest) {
    add(static_cast<int>(std::floor(place)), 1.0f);
    return taps;
  }
  const float below = std::floor(place - 0.5f);
  const float t = place - 0.5f - below, s = 1.0f - t;
  const int first = static_cast<int>(below);
  if (filter == GridFilter::linear) {
    add(first, s);
    add(first + 1, t);
    return taps;
  }
  // The uniform cubic B-spline.
  add(first - 1, s * s * s / 6.0f);
  add(first, (4.0f - 3.0f * t * t * (2.0f - t)) / 6.0f);
  add(first + 1, (4.0f - 3.0f * s * s * (2.0f - s)) / 6.0f);
  add(first + 2, t * t * t / 6.0f);
  return taps;
}

// False for what is not a number too.
bool VoxelGrid::reaches(Vec3 p) const {
  const auto is_near = [&](float x, int size) {
    // A spline reaches two voxels out.
    const float beyond = border_ == GridBorder::extended ? 0.0f : 2.0f / static_cast<float>(size);
    return x >= -beyond && x <= 1.0f + beyond;
  };
  return is_near(p.x, resolution_[0]) && is_near(p.y, resolution_[1]) &&
         is_near(p.z, resolution_[2]);
}

VoxelGrid::Rgba VoxelGrid::lookup(Vec3 p, GridFilter filter) const {
  if (!reaches(p)) return {};
  const Taps x = taps(p.x, 0, filter), y = taps(p.y, 1, filter), z = taps(p.z, 2, filter);
  Rgba sum{};
  for (size_t k = 0; k < z.count; ++k)
    for (size_t j = 0; j < y.count; ++j) {
      const size_t bricks = z.bricks[k] + y.bricks[j], voxels = z.voxels[k] + y.voxels[j];
      for (size_t i = 0; i < x.count; ++i) {
        const float weight = x.weights[i] * y.weights[j] * z.weights[k];
        const float* voxel = table_[bricks + x.bricks[i]] + voxels + x.voxels[i];
        for (size_t c = 0; c < channels_; ++c)
          sum[c] += weight * voxel[c];
      }
    }
  if (channels_ == 1) sum[1] = sum[2] = sum[0];
  if (channels_ < 4) sum[3] = 1.0f;
  return sum;
}

}  // namespace tenniel
