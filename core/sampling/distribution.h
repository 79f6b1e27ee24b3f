// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace tenniel {

// Discrete choice with given weights in constant time (Vose 1991). Negative and non-finite weights
// count as 0; if all are 0 the table is empty and `sample` must not be called.
class AliasTable {
 public:
  AliasTable() = default;
  explicit AliasTable(std::span<const float> weights);

  struct Choice {
    uint32_t index;
    float probability;
    float remapped_u;  // `u` made fresh, in [0, 1)
  };
  Choice sample(float u) const;
  float probability(uint32_t index) const { return entries_[index].probability; }
  size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }
  double total() const { return total_; }

 private:
  struct Entry {
    float threshold;  // keep this entry when the fraction is below
    uint32_t alias;
    float probability;
  };
  std::vector<Entry> entries_;
  double total_ = 0.0;
};

// A float without the lower half of its bits: three digits are enough of a density that is but a
// guess, and tables of them miss the cache half as often.
class ShortFloat {
 public:
  static constexpr ShortFloat nearest(float x) {
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    ShortFloat result;
    result.upper_bits_ = static_cast<uint16_t>((bits + 0x7fffu + (bits >> 16 & 1u)) >> 16);
    return result;
  }
  constexpr float value() const { return std::bit_cast<float>(uint32_t{upper_bits_} << 16); }

 private:
  uint16_t upper_bits_ = 0;
};

// Rows of running sums over their last, to be searched without a branch that depends on the number:
// by the ends of groups first, then within one.
class RunningShares {
 public:
  RunningShares() = default;
  explicit RunningShares(size_t length) : length_(length) {}

  void append(std::span<const double> sums);  // `length` of them, none below the one before
  // The first share of `row` that lies beyond `u`, in [0, 1), which becomes its place within it.
  size_t choose(size_t row, float& u) const;

 private:
  static constexpr size_t k_group = 16;
  size_t length_ = 0;
  std::vector<float> shares_;  // (rows, length)
  std::vector<float> ends_;    // (rows, length / k_group) the last share of each whole group
};

// Density over [0,1)^2, bilinear between the corners of width x height cells, sampled by inversion
// level by level: `u.y` chooses a row, `u.x` a block of it and a cell of that, and what is left of
// both the place in the cell. Keeps the stratification of `u`.
class Distribution2D {
 public:
  Distribution2D() = default;
  // `values` at the corners: (height + 1, width + 1) row-major, row 0 at y = 0; negative and
  // non-finite count as 0.
  Distribution2D(std::vector<float> values, int width, int height);

  struct Sample {
    Vec2 position;  // [0,1)^2
    float pdf;      // density over the unit square; integrates to 1
  };
  Sample sample(Vec2 u) const;
  float pdf(Vec2 position) const;
  bool empty() const { return density_.empty(); }
  double average() const { return average_; }

 private:
  // Cells of a row that share an entry of `blocks_`. Which of them is meant is found among their
  // densities, two cache lines that the sample needs in any case.
  static constexpr int k_block = 8;
  using Corners = std::array<float, 4>;  // lower left, lower right, upper left, upper right
  using Masses = std::array<float, k_block>;

  const ShortFloat* corner(int x, int y) const;
  Corners corners(int x, int y) const;
  // Four times what the cells of a block hold; beyond the grid nothing.
  Masses masses(int block, int y) const;
  int choose_in_block(int block, int y, float& u) const;
  size_t blocks_per_row() const { return (static_cast<size_t>(width_) + k_block - 1) / k_block; }
  void accumulate_rows();

  // At the corners, up to a factor, and room behind the last for a whole block.
  std::vector<ShortFloat> density_;
  float to_density_ = 0.0f;
  RunningShares rows_;    // one row: the shares of the rows of cells
  RunningShares blocks_;  // for each row of cells the shares of its blocks
  int width_ = 0, height_ = 0;
  double average_ = 0.0;
};

}  // namespace tenniel
