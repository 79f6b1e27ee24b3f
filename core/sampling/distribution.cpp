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
  density_.resize(values.size() + k_block);
  std::transform(values.begin(), values.end(), density_.begin(), [this](float value) {
    return ShortFloat::nearest(static_cast<float>(usable_weight(value) / average_));
  });
  accumulate_rows();
}

namespace {

size_t count_up_to(std::span<const float> sorted, float u) {
  size_t count = 0;
  for (const float value : sorted)
    count += value <= u ? 1 : 0;
  return count;
}

}  // namespace

// The last sum that adds anything becomes 1 exactly, so that no number lies beyond it.
void RunningShares::append(std::span<const double> sums) {
  const double total = sums.back();
  for (size_t i = 0; i < sums.size(); ++i) {
    const float share = total > 0.0 ? static_cast<float>(sums[i] / total) : 0.0f;
    shares_.push_back(share);
    if ((i + 1) % k_group == 0) ends_.push_back(share);
  }
}

size_t RunningShares::choose(size_t row, float& u) const {
  const size_t groups = length_ / k_group;
  const size_t group = count_up_to(std::span(ends_).subspan(row * groups, groups), u);
  const auto shares = std::span(shares_).subspan(row * length_, length_);
  const size_t first = group * k_group;
  const size_t chosen =
      first + count_up_to(shares.subspan(first, std::min(k_group, length_ - first)), u);
  const float below = chosen == 0 ? 0.0f : shares[chosen - 1];
  u = std::min((u - below) / (shares[chosen] - below), k_one_minus_epsilon);
  return chosen;
}

void Distribution2D::accumulate_rows() {
  const size_t blocks = blocks_per_row();
  const auto rows = static_cast<size_t>(height_);
  rows_ = RunningShares(rows);
  blocks_ = RunningShares(blocks);
  std::vector<double> of_rows(rows), of_blocks(blocks);
  double total = 0.0;
  for (size_t y = 0; y < rows; ++y) {
    double in_row = 0.0;
    for (size_t block = 0; block < blocks; ++block) {
      for (const float mass : masses(static_cast<int>(block), static_cast<int>(y)))
        in_row += double{mass};
      of_blocks[block] = in_row;
    }
    blocks_.append(of_blocks);
    of_rows[y] = total += in_row;
  }
  rows_.append(of_rows);
  // A mass is four times what a cell holds. The short densities are their own measure.
  to_density_ = static_cast<float>(4.0 * static_cast<double>(width_) * height_ / total);
}

const ShortFloat* Distribution2D::corner(int x, int y) const {
  const size_t stride = static_cast<size_t>(width_) + 1;
  return &density_[static_cast<size_t>(y) * stride + static_cast<size_t>(x)];
}

Distribution2D::Corners Distribution2D::corners(int x, int y) const {
  const ShortFloat *lower = corner(x, y), *upper = corner(x, y + 1);
  return {lower[0].value(), lower[1].value(), upper[0].value(), upper[1].value()};
}

Distribution2D::Masses Distribution2D::masses(int block, int y) const {
  const ShortFloat *lower = corner(block * k_block, y), *upper = corner(block * k_block, y + 1);
  const int count = width_ - block * k_block;
  Masses result;
  for (int i = 0; i < k_block; ++i) {
    const float mass =
        (lower[i].value() + upper[i].value()) + (lower[i + 1].value() + upper[i + 1].value());
    result[static_cast<size_t>(i)] = i < count ? mass : 0.0f;
  }
  return result;
}

// The cell of a block that `u` falls in; `u` becomes its place within that cell.
int Distribution2D::choose_in_block(int block, int y, float& u) const {
  const Masses mass = masses(block, y);
  Masses sums;
  float sum = 0.0f;
  for (size_t i = 0; i < k_block; ++i)
    sums[i] = sum += mass[i];
  const float at = u * sum;
  size_t chosen = 0;
  for (size_t i = 0; i + 1 < k_block; ++i)
    chosen += sums[i] <= at ? 1 : 0;
  // Rounding may have led past the last cell that holds anything.
  while (chosen > 0 && !(mass[chosen] > 0.0f))
    --chosen;
  const float below = chosen == 0 ? 0.0f : sums[chosen - 1];
  u = std::clamp((at - below) / mass[chosen], 0.0f, k_one_minus_epsilon);
  return block * k_block + static_cast<int>(chosen);
}

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
  const size_t row = rows_.choose(0, u.y), block = blocks_.choose(row, u.x);
  const int y = static_cast<int>(row), x = choose_in_block(static_cast<int>(block), y, u.x);
  const Corners c = corners(x, y);
  const BilinearSquare cell(c);
  const Vec2 at = cell.sample(u);
  const auto place = [](int index, float fraction, int count) {
    return std::min((static_cast<float>(index) + fraction) / static_cast<float>(count),
                    k_one_minus_epsilon);
  };
  return {{place(x, at.x, width_), place(y, at.y, height_)}, bilinear(c, at) * to_density_};
}

float Distribution2D::pdf(Vec2 position) const {
  if (empty()) return 0.0f;
  const float x = position.x * static_cast<float>(width_);
  const float y = position.y * static_cast<float>(height_);
  const int column = std::clamp(static_cast<int>(x), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(y), 0, height_ - 1);
  return bilinear(corners(column, row),
                  {x - static_cast<float>(column), y - static_cast<float>(row)}) *
         to_density_;
}

}  // namespace tenniel
