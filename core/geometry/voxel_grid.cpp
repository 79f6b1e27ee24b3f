// SPDX-License-Identifier: Apache-2.0
#include "geometry/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tenniel {

VoxelGrid::VoxelGrid(std::shared_ptr<Values> values, std::array<int, 3> resolution, int channels)
    : resolution_(resolution), channels_(static_cast<size_t>(channels)) {
  std::replace_if(
      values->begin(), values->end(), [](float x) { return !std::isfinite(x); }, 0.0f);
  values_ = std::move(values);
}

// Voxels have their values in their middle; beyond the outermost ones they go on as they are.
VoxelGrid::Taps VoxelGrid::taps(float x, int size, GridFilter filter) {
  const auto inside = [size](int i) { return std::clamp(i, 0, size - 1); };
  const float place = x * static_cast<float>(size);
  Taps taps;
  if (filter == GridFilter::closest) {
    taps.voxels[0] = inside(static_cast<int>(place));
    taps.weights[0] = 1.0f;
    return taps;
  }
  const float below = std::floor(place - 0.5f);
  const float t = place - 0.5f - below, s = 1.0f - t;
  const int first = static_cast<int>(below);
  if (filter == GridFilter::linear) {
    taps.count = 2;
    taps.weights = {s, t, 0.0f, 0.0f};
    taps.voxels = {inside(first), inside(first + 1), 0, 0};
    return taps;
  }
  // The uniform cubic B-spline.
  taps.count = 4;
  taps.weights = {s * s * s / 6.0f, (4.0f - 3.0f * t * t * (2.0f - t)) / 6.0f,
                  (4.0f - 3.0f * s * s * (2.0f - s)) / 6.0f, t * t * t / 6.0f};
  taps.voxels = {inside(first - 1), inside(first), inside(first + 1), inside(first + 2)};
  return taps;
}

VoxelGrid::Rgba VoxelGrid::lookup(Vec3 p, GridFilter filter) const {
  const auto in_unit = [](float x) { return x >= 0.0f && x <= 1.0f; };
  if (!in_unit(p.x) || !in_unit(p.y) || !in_unit(p.z)) return {};
  const Taps x = taps(p.x, resolution_[0], filter), y = taps(p.y, resolution_[1], filter),
             z = taps(p.z, resolution_[2], filter);
  Rgba sum{};
  for (size_t k = 0; k < z.count; ++k)
    for (size_t j = 0; j < y.count; ++j) {
      const size_t row = (static_cast<size_t>(z.voxels[k]) * static_cast<size_t>(resolution_[1]) +
                          static_cast<size_t>(y.voxels[j])) *
                         static_cast<size_t>(resolution_[0]);
      for (size_t i = 0; i < x.count; ++i) {
        const float weight = x.weights[i] * y.weights[j] * z.weights[k];
        const float* voxel = &(*values_)[(row + static_cast<size_t>(x.voxels[i])) * channels_];
        for (size_t c = 0; c < channels_; ++c)
          sum[c] += weight * voxel[c];
      }
    }
  if (channels_ == 1) sum[1] = sum[2] = sum[0];
  if (channels_ < 4) sum[3] = 1.0f;
  return sum;
}

}  // namespace tenniel
