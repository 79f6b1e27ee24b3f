// SPDX-License-Identifier: Apache-2.0
#include "sampling/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "math/numeric.h"
#include "sampling/sampler.h"

namespace tenniel {
namespace {

constexpr int k_samples = 400000;

TEST(AliasTable, ProbabilitiesFollowTheWeights) {
  const std::vector<float> weights{1.0f, 0.0f, 3.0f, -2.0f, std::nanf(""), 4.0f};
  const AliasTable table(weights);
  EXPECT_DOUBLE_EQ(table.total(), 8.0);
  EXPECT_FLOAT_EQ(table.probability(0), 0.125f);
  EXPECT_EQ(table.probability(1), 0.0f);
  EXPECT_FLOAT_EQ(table.probability(2), 0.375f);
  EXPECT_EQ(table.probability(3), 0.0f);
  EXPECT_EQ(table.probability(4), 0.0f);
  EXPECT_FLOAT_EQ(table.probability(5), 0.5f);
}

TEST(AliasTable, IsEmptyWithoutWeight) {
  EXPECT_TRUE(AliasTable(std::vector<float>{0.0f, -1.0f}).empty());
  EXPECT_TRUE(AliasTable(std::vector<float>{}).empty());
  EXPECT_TRUE(AliasTable(std::vector<float>{std::numeric_limits<float>::infinity()}).empty());
  EXPECT_TRUE(AliasTable().empty());
}

// A regular comb over u measures each entry's share to one part in its count.
TEST(AliasTable, DrawsEachEntryAsOftenAsItSays) {
  std::vector<float> weights(301);
  LocalRandom random(8);
  for (float& w : weights)
    w = random.get_1d() < 0.3f ? 0.0f : std::exp(8.0f * random.get_1d());
  const AliasTable table(weights);
  std::vector<double> drawn(weights.size()), remapped(weights.size());
  constexpr int k_comb = 301 * 4096;
  for (int i = 0; i < k_comb; ++i) {
    const AliasTable::Choice c = table.sample((static_cast<float>(i) + 0.5f) / k_comb);
    ASSERT_LT(c.index, weights.size());
    ASSERT_EQ(c.probability, table.probability(c.index));
    ASSERT_GT(c.probability, 0.0f);
    ASSERT_TRUE(c.remapped_u >= 0.0f && c.remapped_u < 1.0f);
    drawn[c.index] += 1.0 / k_comb;
    remapped[c.index] += static_cast<double>(c.remapped_u) / k_comb;
  }
  double sum = 0.0;
  for (size_t i = 0; i < weights.size(); ++i) {
    const double p = table.probability(static_cast<uint32_t>(i));
    sum += p;
    EXPECT_NEAR(drawn[i], p, 1e-4);
    EXPECT_NEAR(remapped[i], 0.5 * p, 1e-4) << "remapped_u is not uniform";
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(AliasTable, NeverDrawsTheImpossible) {
  std::vector<float> weights(1000, 0.0f);
  weights[437] = 1e-30f;
  const AliasTable table(weights);
  for (int i = 0; i < 5000; ++i)
    ASSERT_EQ(table.sample(static_cast<float>(i) / 5000.0f).index, 437u);
  EXPECT_EQ(table.sample(k_one_minus_epsilon).index, 437u);
}

// Cells, and values at their corners.
struct Grid {
  const char* name;
  int width, height;
  std::vector<float> values;

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width + 1) + static_cast<size_t>(x);
  }
};

Grid dark_grid(const char* name, int width, int height, float value = 0.0f) {
  return {name, width, height,
          std::vector<float>(static_cast<size_t>((width + 1) * (height + 1)), value)};
}

Grid random_grid(const char* name, int width, int height) {
  Grid grid = dark_grid(name, width, height);
  LocalRandom random(static_cast<uint32_t>(width * 1000 + height));
  for (float& value : grid.values)
    value = std::exp(6.0f * random.get_1d());
  return grid;
}

std::vector<Grid> grids() {
  std::vector<Grid> all{random_grid("power of two", 16, 8), random_grid("odd", 13, 7),
                        random_grid("row", 9, 1),           random_grid("column", 1, 5),
                        random_grid("cell", 1, 1),          random_grid("many rows", 3, 75),
                        random_grid("many blocks", 300, 2)};
  Grid zero_rows = random_grid("zero rows", 10, 6);
  for (int x = 0; x <= 10; ++x)
    for (const int y : {0, 3, 4, 6})
      zero_rows.values[zero_rows.index(x, y)] = 0.0f;
  zero_rows.values[zero_rows.index(2, 1)] = -4.0f;
  zero_rows.values[zero_rows.index(3, 1)] = std::nanf("");
  all.push_back(zero_rows);
  Grid single = dark_grid("single", 33, 17);
  single.values[single.index(33, 17)] = 2.5e-20f;
  all.push_back(single);
  Grid sun = dark_grid("sun", 64, 32, 1e-3f);
  sun.values[sun.index(60, 10)] = 1e6f;
  all.push_back(sun);
  return all;
}

TEST(Distribution2D, PdfIntegratesToOne) {
  for (const Grid& g : grids()) {
    const Distribution2D d(g.values, g.width, g.height);
    double sum = 0.0, total = 0.0;
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        const Vec2 p{(static_cast<float>(x) + 0.5f) / static_cast<float>(g.width),
                     (static_cast<float>(y) + 0.5f) / static_cast<float>(g.height)};
        sum += static_cast<double>(d.pdf(p)) / (g.width * g.height);
        double cell = 0.0;
        for (const size_t corner : {g.index(x, y), g.index(x, y + 1)})
          for (const float v : {g.values[corner], g.values[corner + 1]})
            cell += v > 0.0f ? 0.25 * v : 0.0;
        total += cell;
        if (cell == 0.0) {
          EXPECT_EQ(d.pdf(p), 0.0f) << g.name;
        }
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << g.name;
    EXPECT_NEAR(d.average() / (total / (g.width * g.height)), 1.0, 1e-9) << g.name;
  }
}

// Histogram of the samples over `columns` x `rows` bins, which need not be those of the grid,
// against the pdf integrated over each bin by a fine regular sum.
void expect_samples_follow_pdf(const Grid& g, int columns, int rows) {
  const Distribution2D d(g.values, g.width, g.height);
  const size_t bins = static_cast<size_t>(columns) * static_cast<size_t>(rows);
  std::vector<double> expected(bins), counts(bins);
  const int sub_x = columns * g.width, sub_y = rows * g.height;  // no cell straddles a bin
  for (int j = 0; j < sub_y; ++j) {
    for (int i = 0; i < sub_x; ++i) {
      const Vec2 p{(static_cast<float>(i) + 0.5f) / static_cast<float>(sub_x),
                   (static_cast<float>(j) + 0.5f) / static_cast<float>(sub_y)};
      const int bin = (j / g.height) * columns + i / g.width;
      expected[static_cast<size_t>(bin)] += static_cast<double>(d.pdf(p)) / sub_x / sub_y;
    }
  }
  LocalRandom random(77);
  for (int n = 0; n < k_samples; ++n) {
    const auto s = d.sample(random.get_2d());
    ASSERT_TRUE(s.position.x >= 0.0f && s.position.x < 1.0f) << g.name;
    ASSERT_TRUE(s.position.y >= 0.0f && s.position.y < 1.0f) << g.name;
    ASSERT_GT(s.pdf, 0.0f) << g.name;
    const auto column = static_cast<size_t>(s.position.x * static_cast<float>(columns));
    const auto row = static_cast<size_t>(s.position.y * static_cast<float>(rows));
    counts[row * static_cast<size_t>(columns) + column] += 1.0;
  }
  double chi2 = 0.0, freedom = -1.0;
  for (size_t i = 0; i < bins; ++i) {
    const double mean = expected[i] * k_samples;
    if (mean < 5.0) continue;
    chi2 += (counts[i] - mean) * (counts[i] - mean) / mean;
    freedom += 1.0;
  }
  if (freedom > 0.0) {
    EXPECT_LT((chi2 - freedom) / std::sqrt(2.0 * freedom), 4.5) << g.name;
  }
}

TEST(Distribution2DStatistics, SamplesFollowThePdf) {
  for (const Grid& g : grids()) {
    expect_samples_follow_pdf(g, g.width, g.height);
    expect_samples_follow_pdf(g, 7, 5);
  }
}

TEST(Distribution2D, IsBilinearBetweenTheCorners) {
  const Distribution2D d({1.0f, 3.0f, 5.0f, 7.0f}, 1, 1);
  EXPECT_DOUBLE_EQ(d.average(), 4.0);
  EXPECT_FLOAT_EQ(d.pdf({0.0f, 0.0f}), 0.25f);
  EXPECT_FLOAT_EQ(d.pdf({0.5f, 0.0f}), 0.5f);
  EXPECT_FLOAT_EQ(d.pdf({0.25f, 0.75f}), (1.0f + 0.5f + 3.0f) / 4.0f);
}

TEST(Distribution2D, SampleAndPdfAgree) {
  for (const Grid& g : grids()) {
    const Distribution2D d(g.values, g.width, g.height);
    LocalRandom random(5);
    for (int i = 0; i < 2000; ++i) {
      const auto s = d.sample(random.get_2d());
      // The place in its cell is rounded: the steeper the cell, the more this says.
      const auto w = static_cast<float>(g.width), h = static_cast<float>(g.height);
      const float x = std::floor(s.position.x * w), y = std::floor(s.position.y * h);
      float steepest = 0.0f;
      for (const Vec2 corner :
           {Vec2{x, y}, Vec2{x + 1.0f, y}, Vec2{x, y + 1.0f}, Vec2{x + 1.0f, y + 1.0f}})
        steepest = std::max(steepest, d.pdf({corner.x / w, corner.y / h}));
      ASSERT_NEAR(s.pdf, d.pdf(s.position), 3e-5f * steepest) << g.name;
    }
  }
}

TEST(ShortFloat, IsTheNearestOfThreeDigits) {
  for (const float exact : {0.0f, 1.0f, -2.5f, 1e30f}) {
    const float once = ShortFloat::nearest(exact).value();
    EXPECT_NEAR(once, exact, std::abs(exact) * 0x1p-9f);
    EXPECT_EQ(ShortFloat::nearest(once).value(), once);
  }
  EXPECT_EQ(ShortFloat::nearest(1.0f + 0x1p-8f).value(), 1.0f);  // a tie goes to the even one
  EXPECT_EQ(ShortFloat::nearest(1.0f + 0x1.8p-8f).value(), 1.0f + 0x1p-7f);
}

TEST(Distribution2D, KeepsStratification) {
  const Distribution2D d(std::vector<float>(81, 2.0f), 8, 8);
  const auto s = d.sample({0.3f, 0.8f});
  EXPECT_NEAR(s.position.x, 0.3f, 1e-6f);
  EXPECT_NEAR(s.position.y, 0.8f, 1e-6f);
  EXPECT_FLOAT_EQ(s.pdf, 1.0f);
}

TEST(Distribution2D, IsEmptyWithoutLight) {
  const Distribution2D d(std::vector<float>(20, 0.0f), 4, 3);
  EXPECT_TRUE(d.empty());
  EXPECT_EQ(d.pdf({0.5f, 0.5f}), 0.0f);
  EXPECT_EQ(d.average(), 0.0);
  EXPECT_TRUE(Distribution2D().empty());
}

TEST(Distribution2D, HugeValuesDoNotOverflow) {
  const Distribution2D d(std::vector<float>(25, 3e38f), 4, 4);
  EXPECT_FLOAT_EQ(d.sample({0.1f, 0.9f}).pdf, 1.0f);
}

}  // namespace
}  // namespace tenniel
