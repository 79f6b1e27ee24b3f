// SPDX-License-Identifier: Apache-2.0
#include "image/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr int k_side = VoxelGrid::k_brick_side;
// Of a brick in memory: its own voxels and the first of the next brick.
constexpr size_t k_stored_side = k_side + 1;
constexpr size_t k_stored_voxels = k_stored_side * k_stored_side * k_stored_side;
constexpr std::array<size_t, 3> k_voxel_strides{1, k_stored_side, k_stored_side* k_stored_side};

size_t bricks_along(int voxels) {
  return static_cast<size_t>((voxels + k_side - 1) / k_side);
}

}  // namespace

VoxelGrid::VoxelGrid(std::array<int, 3> resolution, int channels, GridBorder border)
    : resolution_(resolution), channels_(static_cast<size_t>(channels)), border_(border) {
  const size_t x = bricks_along(resolution[0]), y = bricks_along(resolution[1]);
  brick_strides_ = {1, x, x * y};
  bricks_.push_back(std::make_unique<float[]>(k_stored_voxels * channels_));
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
  finish();
}

void VoxelGrid::set_brick(std::array<int, 3> brick, const float* values) {
  const auto usable = [](float v) { return std::isfinite(v) ? v : 0.0f; };
  const float* const end = values + k_brick_voxels * channels_;
  if (std::none_of(values, end, [&](float v) { return usable(v) != 0.0f; })) return;
  const auto& made = bricks_.emplace_back(std::make_unique<float[]>(k_stored_voxels * channels_));
  const size_t row = static_cast<size_t>(k_side) * channels_;
  for (size_t z = 0; z < k_side; ++z)
    for (size_t y = 0; y < k_side; ++y, values += row)
      std::transform(values, values + row,
                     &made[(z * k_voxel_strides[2] + y * k_voxel_strides[1]) * channels_], usable);
  size_t index = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    index += static_cast<size_t>(brick[axis]) * brick_strides_[axis];
  table_[index] = made.get();
}

void VoxelGrid::finish(const Cancellation& cancellation) {
  const std::array<size_t, 3> count{bricks_along(resolution_[0]), bricks_along(resolution_[1]),
                                    bricks_along(resolution_[2])};
  for (size_t z = 0; z < count[2]; ++z)
    for (size_t y = 0; y < count[1]; ++y) {
      cancellation.check();
      for (size_t x = 0; x < count[0]; ++x)
        repeat_next_bricks({x, y, z});
    }
  if (border_ != GridBorder::empty) return;
  const auto is_filled = [this](std::array<size_t, 3> block) { return is_block_filled(block); };
  empty_blocks_ = EmptyBlocks(resolution_, is_filled, cancellation);
}

// Of a voxel that may lie one beyond the last: what the border says.
float VoxelGrid::value_near(std::array<size_t, 3> voxel, size_t channel) const {
  size_t brick = 0, within = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto last = static_cast<size_t>(resolution_[axis] - 1);
    if (voxel[axis] > last && border_ == GridBorder::empty) return 0.0f;
    const size_t i = std::min(voxel[axis], last);
    brick += i / k_side * brick_strides_[axis];
    within += i % k_side * k_voxel_strides[axis];
  }
  return table_[brick][within * channels_ + channel];
}

void VoxelGrid::repeat_next_bricks(std::array<size_t, 3> brick) {
  float* const values = table_[brick[0] * brick_strides_[0] + brick[1] * brick_strides_[1] +
                               brick[2] * brick_strides_[2]];
  if (values == bricks_.front().get()) return;
  std::array<size_t, 3> first, end;
  for (size_t axis = 0; axis < 3; ++axis) {
    first[axis] = brick[axis] * k_side;
    // Voxels of the brick itself that the grid has not count as beyond the last.
    end[axis] = std::min<size_t>(k_side, static_cast<size_t>(resolution_[axis]) - first[axis]);
  }
  for (size_t z = 0; z <= end[2]; ++z)
    for (size_t y = 0; y <= end[1]; ++y)
      for (size_t x = 0; x <= end[0]; ++x) {
        if (x < end[0] && y < end[1] && z < end[2]) continue;
        const size_t within =
            x * k_voxel_strides[0] + y * k_voxel_strides[1] + z * k_voxel_strides[2];
        for (size_t c = 0; c < channels_; ++c)
          values[within * channels_ + c] =
              value_near({first[0] + x, first[1] + y, first[2] + z}, c);
      }
}

size_t VoxelGrid::memory_bytes() const {
  return bricks_.size() * k_stored_voxels * channels_ * sizeof(float) +
         table_.size() * sizeof(table_[0]) + empty_blocks_.memory_bytes();
}

// Voxels have their values in their middle.
VoxelGrid::Taps VoxelGrid::taps(float x, size_t axis, GridFilter filter) const {
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

bool VoxelGrid::is_block_filled(std::array<size_t, 3> block) const {
  constexpr size_t k_blocks = k_side / EmptyBlocks::k_side;
  constexpr size_t k_block = EmptyBlocks::k_side;
  size_t brick = 0, within = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    brick += block[axis] / k_blocks * brick_strides_[axis];
    within += block[axis] % k_blocks * k_block * k_voxel_strides[axis];
  }
  const float* const values = table_[brick];
  if (values == bricks_.front().get()) return false;
  for (size_t z = 0; z < k_block; ++z)
    for (size_t y = 0; y < k_block; ++y) {
      const float* const row =
          values + (within + z * k_voxel_strides[2] + y * k_voxel_strides[1]) * channels_;
      if (std::any_of(row, row + k_block * channels_, [](float v) { return v != 0.0f; }))
        return true;
    }
  return false;
}

Vec3 VoxelGrid::in_voxels(Vec3 v) const {
  return {v.x * static_cast<float>(resolution_[0]), v.y * static_cast<float>(resolution_[1]),
          v.z * static_cast<float>(resolution_[2])};
}

float VoxelGrid::empty_until(Vec3 p, Vec3 direction) const {
  if (border_ != GridBorder::empty) return 0.0f;
  return empty_blocks_.until(in_voxels(p), in_voxels(direction));
}

// The first of the eight voxels around `place`, counted from the middle of the first voxel; null
// where they are in no filled brick.
const float* VoxelGrid::find_cell(Vec3 place, std::array<float, 3>& fractions) const {
  size_t brick = 0, voxel = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const float x = place[static_cast<int>(axis)];
    if (!(x >= 0.0f && x < static_cast<float>(resolution_[axis]))) return nullptr;
    const auto i = static_cast<size_t>(x);
    fractions[axis] = x - static_cast<float>(i);
    brick += i / k_side * brick_strides_[axis];
    voxel += i % k_side * k_voxel_strides[axis];
  }
  const float* const values = table_[brick];
  return values != bricks_.front().get() ? values + voxel * channels_ : nullptr;
}

VoxelGrid::Rgba VoxelGrid::gather(const Taps& x, const Taps& y, const Taps& z) const {
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
  return sum;
}

VoxelGrid::Rgba VoxelGrid::lookup(Vec3 p, GridFilter filter) const {
  if (!reaches(p)) return {};
  Rgba sum{};
  std::array<float, 3> t{};
  const float* cell =
      filter == GridFilter::linear ? find_cell(in_voxels(p) - Vec3{0.5f, 0.5f, 0.5f}, t) : nullptr;
  if (!cell) {
    sum = gather(taps(p.x, 0, filter), taps(p.y, 1, filter), taps(p.z, 2, filter));
  } else {
    for (size_t c = 0; c < channels_; ++c, ++cell) {
      const auto along_x = [&](size_t first) {
        return lerp(cell[first * channels_], cell[(first + 1) * channels_], t[0]);
      };
      constexpr size_t k_y = k_voxel_strides[1], k_z = k_voxel_strides[2];
      sum[c] = lerp(lerp(along_x(0), along_x(k_y), t[1]),
                    lerp(along_x(k_z), along_x(k_z + k_y), t[1]), t[2]);
    }
  }
  if (channels_ == 1) sum[1] = sum[2] = sum[0];
  if (channels_ < 4) sum[3] = 1.0f;
  return sum;
}

}  // namespace tenniel
