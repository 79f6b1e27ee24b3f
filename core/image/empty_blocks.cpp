// SPDX-License-Identifier: Apache-2.0
#include "image/empty_blocks.h"

#include <algorithm>

#include "math/ray.h"

namespace tenniel {

namespace {

constexpr int k_far = 255;

// Where a ray is in a box; empty where `entry` is greater than `exit`.
struct Span {
  float entry = 0.0f, exit = k_infinity;
};

Span span_in_box(Vec3 from, Vec3 step, Vec3 low, Vec3 high) {
  Span span;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(step[axis] != 0.0f)) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) span.exit = -k_infinity;
      continue;
    }
    const float a = (low[axis] - from[axis]) / step[axis];
    const float b = (high[axis] - from[axis]) / step[axis];
    span.entry = std::max(span.entry, std::min(a, b));
    span.exit = std::min(span.exit, std::max(a, b));
  }
  return span;
}

}  // namespace

EmptyBlocks::EmptyBlocks(std::array<int, 3> voxels,
                         const std::function<bool(std::array<size_t, 3>)>& is_filled,
                         const Cancellation& cancellation)
    : voxels_(voxels) {
  size_t stride = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    counts_[axis] = static_cast<size_t>((voxels[axis] + k_side - 1) / k_side);
    strides_[axis] = stride;
    stride *= counts_[axis];
  }
  distances_.reserve(stride);
  for (size_t z = 0; z < counts_[2]; ++z)
    for (size_t y = 0; y < counts_[1]; ++y) {
      cancellation.check();
      for (size_t x = 0; x < counts_[0]; ++x)
        distances_.push_back(is_filled({x, y, z}) ? 0 : k_far);
    }
  // From the nearest along x to the nearest of all.
  for (size_t axis = 0; axis < 3; ++axis)
    spread_along(axis, cancellation);
}

void EmptyBlocks::spread_along(size_t axis, const Cancellation& cancellation) {
  const size_t stride = strides_[axis], count = counts_[axis];
  std::vector<uint8_t> line(count);
  for (size_t first = 0; first < distances_.size(); ++first) {
    if (first / stride % count != 0) continue;
    cancellation.check();
    for (size_t i = 0; i < count; ++i)
      line[i] = distances_[first + i * stride];
    if (std::all_of(line.begin(), line.end(), [](uint8_t d) { return d == k_far; })) continue;
    for (size_t i = 0; i < count; ++i) {
      int least = k_far;
      // Blocks further away than the best so far cannot be better.
      for (size_t away = 0; static_cast<int>(away) < least; ++away) {
        if (away > i && i + away >= count) break;
        const int step = static_cast<int>(away);
        if (i >= away) least = std::min(least, std::max<int>(line[i - away], step));
        if (i + away < count) least = std::min(least, std::max<int>(line[i + away], step));
      }
      distances_[first + i * stride] = static_cast<uint8_t>(least);
    }
  }
}

float EmptyBlocks::until(Vec3 from, Vec3 step) const {
  if (distances_.empty()) return k_infinity;
  bool is_inside = true;
  size_t index = 0;
  std::array<int, 3> block{};
  for (size_t axis = 0; axis < 3 && is_inside; ++axis) {
    const float x = from[static_cast<int>(axis)];
    is_inside = x >= 0.0f && x < static_cast<float>(voxels_[axis]);
    block[axis] = is_inside ? static_cast<int>(x) / k_side : 0;
    index += static_cast<size_t>(block[axis]) * strides_[axis];
  }
  Vec3 low, high;
  if (!is_inside) {
    // The whole grid and what lookups outside reach of it.
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = -0.5f;
      high[axis] = static_cast<float>(voxels_[static_cast<size_t>(axis)]) + 0.5f;
    }
    const Span span = span_in_box(from, step, low, high);
    return span.entry <= span.exit ? span.entry : k_infinity;
  }
  // The box of empty blocks around, less what lookups in it reach beyond.
  const int around = distances_[index] - 1;
  if (around < 0) return 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int own = block[static_cast<size_t>(axis)];
    low[axis] = static_cast<float>((own - around) * k_side) + 0.5f;
    high[axis] = static_cast<float>((own + around + 1) * k_side) - 0.5f;
  }
  const Span span = span_in_box(from, step, low, high);
  return span.entry > 0.0f ? 0.0f : std::max(span.exit, 0.0f);
}

}  // namespace tenniel
