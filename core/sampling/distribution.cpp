// SPDX-License-Identifier: Apache-2.0
#include "sampling/distribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "math/numeric.h"
#include "sampling/warp.h"

namespace tenniel {
namespace {

double usable_weight(float w) {
  return std::isfinite(w) && w > 0.0f ? double{w} : 0.0;
}

}  // namespace

AliasTable::AliasTable(std::span<const float> weights) {
  const size_t n = weights.size();
  size_t heaviest = 0;
  for (size_t i = 0; i < n; ++i) {
    total_ += usable_weight(weights[i]);
    if (usable_weight(weights[i]) > usable_weight(weights[heaviest])) heaviest = i;
  }
  if (!(total_ > 0.0)) return;

  entries_.resize(n);
  std::vector<double> scaled(n);  // probability * n
  std::vector<uint32_t> small, large;
  for (size_t i = 0; i < n; ++i) {
    const double probability = usable_weight(weights[i]) / total_;
    scaled[i] = probability * static_cast<double>(n);
    entries_[i].probability = static_cast<float>(probability);
    (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const uint32_t under = small.back(), over = large.back();
    small.pop_back();
    entries_[under].threshold = static_cast<float>(scaled[under]);
    entries_[under].alias = over;
    scaled[over] -= 1.0 - scaled[under];
    if (scaled[over] < 1.0) {
      large.pop_back();
      small.push_back(over);
    }
  }
  for (const uint32_t i : large)
    entries_[i] = {1.0f, i, entries_[i].probability};
  // Left over by rounding only: whole by rights, except what must never be drawn.
  for (const uint32_t i : small) {
    const bool possible = entries_[i].probability > 0.0f;
    entries_[i].threshold = possible ? 1.0f : 0.0f;
    entries_[i].alias = possible ? i : static_cast<uint32_t>(heaviest);
  }
}

AliasTable::Choice AliasTable::sample(float u) const {
  const float scaled = u * static_cast<float>(entries_.size());
  const size_t slot = std::min(static_cast<size_t>(scaled), entries_.size() - 1);
  const float fraction = std::min(scaled - static_cast<float>(slot), k_one_minus_epsilon);
  const Entry& entry = entries_[slot];
  if (fraction < entry.threshold) {
    return {static_cast<uint32_t>(slot), entry.probability,
            std::min(fraction / entry.threshold, k_one_minus_epsilon)};
  }
  const float rest = (fraction - entry.threshold) / (1.0f - entry.threshold);
  return {entry.alias, entries_[entry.alias].probability, std::min(rest, k_one_minus_epsilon)};
}

Distribution2D::Distribution2D(std::vector<float> values, int width, int height) {
  double total = 0.0;
  const auto columns = static_cast<size_t>(width) + 1, rows = static_cast<size_t>(height) + 1;
  for (size_t y = 0; y < rows; ++y) {
    double row = 0.0;
    for (size_t x = 0; x < columns; ++x) {
      const bool is_edge = x == 0 || x + 1 == columns;
      row += usable_weight(values[y * columns + x]) * (is_edge ? 0.5 : 1.0);
    }
    total += row * (y == 0 || y + 1 == rows ? 0.5 : 1.0);
  }
  if (!(total > 0.0)) return;
  average_ = total / (static_cast<double>(width) * static_cast<double>(height));
  width_ = width;
  height_ = height;
  for (float& value : values)
    value = static_cast<float>(usable_weight(value) / average_);
  density_ = std::move(values);
  build_pyramid();
}

void Distribution2D::build_pyramid() {
  int width = (width_ + 1) / 2, height = (height_ + 1) / 2;  // in blocks of 2x2
  const auto sum = [](const float* block) { return (block[0] + block[1]) + (block[2] + block[3]); };
  while (width > 1 || height > 1) {
    const Level* fine = levels_.empty() ? nullptr : &levels_.back();
    Level coarse{width + (width & 1), height + (height & 1), {}};
    coarse.sums.resize(static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        coarse.sums[coarse.at(x, y)] = fine ? sum(&fine->sums[fine->at(2 * x, 2 * y)])
                                            : sum(block_masses(2 * x, 2 * y).data());
    width = coarse.width / 2;
    height = coarse.height / 2;
    levels_.push_back(std::move(coarse));
  }
}

Distribution2D::Corners Distribution2D::corners(int x, int y) const {
  const size_t stride = static_cast<size_t>(width_) + 1;
  const float* lower = &density_[static_cast<size_t>(y) * stride + static_cast<size_t>(x)];
  return {lower[0], lower[1], lower[stride], lower[stride + 1]};
}

Distribution2D::Corners Distribution2D::block_masses(int x, int y) const {
  const auto mass = [this](int column, int row) {
    if (column >= width_ || row >= height_) return 0.0f;
    const Corners c = corners(column, row);
    return 0.25f * ((c[0] + c[1]) + (c[2] + c[3]));
  };
  return {mass(x, y), mass(x + 1, y), mass(x, y + 1), mass(x + 1, y + 1)};
}

namespace {

// Chooses the upper of two halves when `u` says so, and stretches `u` over the half it fell in.
bool warp_half(float& u, float lower, float upper) {
  const float split = lower / (lower + upper);
  const bool takes_upper = u >= split;
  u = takes_upper ? (u - split) / (1.0f - split) : u / split;
  u = std::min(u, k_one_minus_epsilon);
  return takes_upper;
}

// The part of a block of 2x2 that `u` falls in: (x, y) becomes its place on the next finer level.
void descend(const float* block, Vec2& u, int& x, int& y) {
  const int right = warp_half(u.x, block[0] + block[2], block[1] + block[3]);
  const int above = warp_half(u.y, block[right], block[2 + right]);
  x = 2 * x + right;
  y = 2 * y + above;
}

}  // namespace

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
  int x = 0, y = 0;
  for (size_t i = levels_.size(); i-- > 0;)
    descend(&levels_[i].sums[levels_[i].at(2 * x, 2 * y)], u, x, y);
  descend(block_masses(2 * x, 2 * y).data(), u, x, y);
  const Corners c = corners(x, y);
  const BilinearSquare cell(c);
  const Vec2 at = cell.sample(u);
  const auto place = [](int index, float fraction, int count) {
    return std::min((static_cast<float>(index) + fraction) / static_cast<float>(count),
                    k_one_minus_epsilon);
  };
  return {{place(x, at.x, width_), place(y, at.y, height_)}, bilinear(c, at)};
}

float Distribution2D::pdf(Vec2 position) const {
  if (empty()) return 0.0f;
  const float x = position.x * static_cast<float>(width_);
  const float y = position.y * static_cast<float>(height_);
  const int column = std::clamp(static_cast<int>(x), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(y), 0, height_ - 1);
  return bilinear(corners(column, row),
                  {x - static_cast<float>(column), y - static_cast<float>(row)});
}

}  // namespace tenniel
