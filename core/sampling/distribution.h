// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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

// Density over [0,1)^2, bilinear between the corners of width x height cells, sampled by
// hierarchical warping down a pyramid of 2x2 sums (Clarberg et al. 2005): keeps the stratification
// of `u`.
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
  using Corners = std::array<float, 4>;  // lower left, lower right, upper left, upper right
  struct Level {
    int width = 0, height = 0;  // padded to even, the padding is 0
    std::vector<float> sums;    // blocks of 2x2 in a row: one descent reads one cache line
    size_t at(int x, int y) const {
      const int block = (y >> 1) * (width >> 1) + (x >> 1);
      return static_cast<size_t>(block) * 4 + static_cast<size_t>((y & 1) * 2 + (x & 1));
    }
  };
  Corners corners(int x, int y) const;
  // What the four cells around the corner (x + 1, y + 1) hold; beyond the grid nothing.
  Corners block_masses(int x, int y) const;
  void build_pyramid();

  std::vector<float> density_;  // at the corners
  std::vector<Level> levels_;   // from sums of 2x2 cells to at most 2x2 sums
  int width_ = 0, height_ = 0;
  double average_ = 0.0;
};

}  // namespace tenniel
