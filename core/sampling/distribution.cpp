// SPDX-License-Identifier: Apache-2.0
#include "sampling/distribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/numeric.h"

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

Distribution2D::Distribution2D(std::span<const float> values, int width, int height)
    : width_(width), height_(height) {
  double total = 0.0;
  for (const float v : values)
    total += usable_weight(v);
  if (!(total > 0.0)) return;
  average_ = total / (static_cast<double>(width) * static_cast<double>(height));

  const auto padded = [](int w, int h) {
    Level level{w + (w & 1), h + (h & 1), {}};
    level.sums.resize(static_cast<size_t>(level.width) * static_cast<size_t>(level.height));
    return level;
  };
  levels_.push_back(padded(width, height));
  for (int y = 0; y < height; ++y) {
    const float* row = values.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    for (int x = 0; x < width; ++x)
      levels_[0].sums[levels_[0].at(x, y)] = static_cast<float>(usable_weight(row[x]) / average_);
  }
  while (levels_.back().width > 2 || levels_.back().height > 2) {
    const Level& fine = levels_.back();
    Level coarse = padded(fine.width / 2, fine.height / 2);
    for (int y = 0; y < fine.height / 2; ++y) {
      for (int x = 0; x < fine.width / 2; ++x) {
        const float* block = &fine.sums[fine.at(2 * x, 2 * y)];
        coarse.sums[coarse.at(x, y)] = (block[0] + block[1]) + (block[2] + block[3]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
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

}  // namespace

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
  int x = 0, y = 0;
  for (size_t i = levels_.size(); i-- > 0;) {
    const float* block = &levels_[i].sums[levels_[i].at(2 * x, 2 * y)];
    const int right = warp_half(u.x, block[0] + block[2], block[1] + block[3]);
    const int above = warp_half(u.y, block[right], block[2 + right]);
    x = 2 * x + right;
    y = 2 * y + above;
  }
  const auto place = [](int cell, float fraction, int count) {
    return std::min((static_cast<float>(cell) + fraction) / static_cast<float>(count),
                    k_one_minus_epsilon);
  };
  return {{place(x, u.x, width_), place(y, u.y, height_)}, levels_[0].sums[levels_[0].at(x, y)]};
}

float Distribution2D::pdf(Vec2 position) const {
  if (levels_.empty()) return 0.0f;
  const auto cell = [](float p, int count) {
    return std::clamp(static_cast<int>(p * static_cast<float>(count)), 0, count - 1);
  };
  return levels_[0].sums[levels_[0].at(cell(position.x, width_), cell(position.y, height_))];
}

}  // namespace tenniel
