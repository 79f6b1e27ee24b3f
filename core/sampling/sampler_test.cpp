// SPDX-License-Identifier: Apache-2.0
#include "sampling/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace tenniel {
namespace {

// Fails unless each elementary interval of each shape holds exactly one of the 2^log2_count points.
void expect_net(const std::vector<Vec2>& points, int log2_count) {
  for (int bits_x = 0; bits_x <= log2_count; ++bits_x) {
    const int columns = 1 << bits_x, rows = 1 << (log2_count - bits_x);
    std::set<int> cells;
    for (const Vec2 p : points) {
      const int column = static_cast<int>(p.x * static_cast<float>(columns));
      const int row = static_cast<int>(p.y * static_cast<float>(rows));
      EXPECT_TRUE(cells.insert(row * columns + column).second) << columns << " x " << rows;
    }
  }
}

TEST(Sampler, EveryBlockOfEveryDimensionIsANet) {
  for (const int log2_count : {4, 6, 8}) {
    const uint32_t count = 1u << log2_count;
    for (uint32_t dimension = 0; dimension < 24; ++dimension) {
      for (const uint32_t first : {0u, count, 5u * count}) {
        Sampler sampler(7);
        std::vector<Vec2> points;
        for (uint32_t i = first; i < first + count; ++i) {
          sampler.start_sample(31, 17, i);
          sampler.set_dimension(dimension);
          points.push_back(sampler.get_2d());
        }
        expect_net(points, log2_count);
      }
    }
  }
}

TEST(Sampler, OneDimensionalRequestsAreStratified) {
  for (uint32_t dimension = 0; dimension < 64; ++dimension) {
    Sampler sampler(3);
    std::set<int> strata;
    for (uint32_t i = 0; i < 256; ++i) {
      sampler.start_sample(5, 9, i);
      sampler.set_dimension(dimension);
      strata.insert(static_cast<int>(sampler.get_1d() * 256.0f));
    }
    EXPECT_EQ(strata.size(), 256u) << "dimension " << dimension;
  }
}

TEST(Sampler, DependsOnSeedPixelIndexAndDimensionOnly) {
  const auto draw = [](uint32_t seed, int x, int y, uint32_t index, uint32_t dimension) {
    Sampler sampler(seed);
    sampler.start_sample(x, y, index);
    sampler.set_dimension(dimension);
    return sampler.get_1d();
  };
  const float value = draw(1, 2, 3, 4, 5);
  EXPECT_EQ(draw(1, 2, 3, 4, 5), value);
  EXPECT_NE(draw(2, 2, 3, 4, 5), value);
  EXPECT_NE(draw(1, 3, 3, 4, 5), value);
  EXPECT_NE(draw(1, 2, 4, 4, 5), value);
  EXPECT_NE(draw(1, 3, 2, 4, 5), value);
  EXPECT_NE(draw(1, 2, 3, 5, 5), value);
  EXPECT_NE(draw(1, 2, 3, 4, 6), value);

  Sampler used(1);
  used.start_sample(8, 8, 8);
  used.get_2d();
  used.start_sample(2, 3, 4);
  for (int i = 0; i < 5; ++i)
    used.get_2d();
  EXPECT_EQ(used.get_1d(), value) << "a request takes one dimension, whatever came before";
}

void expect_requests(const VertexNumbers& v, Sampler& sampler, uint32_t dimension) {
  sampler.set_dimension(dimension);
  EXPECT_EQ(v.light, sampler.get_1d());
  EXPECT_TRUE(v.on_light == sampler.get_2d());
  EXPECT_EQ(v.flight, sampler.get_1d());
  EXPECT_TRUE(v.wi == sampler.get_2d());
  EXPECT_EQ(v.roulette, sampler.get_1d());
}

TEST(Sampler, NumbersOfAVertexAreThoseOfItsRequests) {
  Sampler one(7), many(7);
  for (uint32_t i = 0; i < 100; ++i) {
    one.start_sample(3, 5, i);
    many.start_sample(3, 5, i);
    const auto two = many.numbers_of_two_vertices(8 + i, 9);
    expect_requests(many.vertex_numbers(8 + i), one, 8 + i);
    expect_requests(two[0], one, 8 + i);
    expect_requests(two[1], one, 17 + i);
  }
}

TEST(Sampler, StaysBelowOne) {
  Sampler sampler(0);
  for (uint32_t i = 0; i < 100000; ++i) {
    sampler.start_sample(static_cast<int>(i % 97), -3, i * 42451u);
    const Vec2 p = sampler.get_2d();
    ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
  }
}

// Largest of |sum a b|, in units of its standard deviation, over pairs of centred streams.
float correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i)
    sum += (static_cast<double>(a[i]) - 0.5) * (static_cast<double>(b[i]) - 0.5);
  return static_cast<float>(std::abs(sum) * 12.0 / std::sqrt(static_cast<double>(a.size())));
}

TEST(SamplerStatistics, DimensionsAndPixelsAreIndependent) {
  constexpr uint32_t k_count = 1024;
  constexpr size_t k_streams = 32;
  const auto stream = [](int x, int y, uint32_t dimension) {
    Sampler sampler(11);
    std::vector<float> values;
    for (uint32_t i = 0; i < k_count; ++i) {
      sampler.start_sample(x, y, i);
      sampler.set_dimension(dimension);
      values.push_back(sampler.get_1d());
    }
    return values;
  };
  for (const bool over_pixels : {false, true}) {
    std::vector<std::vector<float>> streams;
    for (size_t i = 0; i < k_streams; ++i) {
      const auto k = static_cast<int>(i);
      streams.push_back(over_pixels ? stream(k % 8, k / 8, 0)
                                    : stream(4, 4, static_cast<uint32_t>(k)));
    }
    // 496 pairs: 4.5 sigma has a chance of 3e-3 over all of them; the streams are fixed.
    for (size_t i = 0; i < k_streams; ++i)
      for (size_t j = 0; j < i; ++j)
        EXPECT_LT(correlation(streams[i], streams[j]), 4.5f);
  }
}

// Pairs of dimensions fill the square: chi-squared of 16x16 cells with 4096 points. Nested shuffles
// pair the strata of two dimensions block by block, which spreads the statistic more than random
// points do: with a full hash for every scrambled bit its mean is 238 and its deviation 45 (1000
// pairs), not 225 and 21. A poor hash shows in the mean.
TEST(SamplerStatistics, PairsOfDimensionsFillTheSquare) {
  constexpr int k_pairs = 400;
  double mean = 0.0, worst = 0.0;
  for (int pair = 0; pair < k_pairs; ++pair) {
    std::vector<int> counts(256);
    Sampler sampler(2);
    for (uint32_t i = 0; i < 4096; ++i) {
      sampler.start_sample(pair % 20, pair / 20, i);
      const float a = sampler.get_1d();
      sampler.set_dimension(static_cast<uint32_t>(pair % 40) + 1);
      ++counts[static_cast<size_t>(a * 16.0f) * 16 + static_cast<size_t>(sampler.get_1d() * 16.0f)];
    }
    double chi2 = 0.0;
    for (const int c : counts)
      chi2 += (c - 16.0) * (c - 16.0) / 16.0;
    mean += chi2 / k_pairs;
    worst = std::max(worst, chi2);
  }
  EXPECT_LT(mean, 238.0 + 5.0 * 45.0 / 20.0);
  EXPECT_LT(worst, 600.0);
}

TEST(LocalRandom, MatchesItsMomentsAndSeeds) {
  LocalRandom a(5), b(5), c(6);
  double mean = 0.0, square = 0.0;
  constexpr int k_count = 100000;
  for (int i = 0; i < k_count; ++i) {
    const double x = a.get_1d();
    mean += x / k_count;
    square += x * x / k_count;
    ASSERT_EQ(static_cast<float>(x), b.get_1d());
  }
  EXPECT_NEAR(mean, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / k_count));
  EXPECT_NEAR(square, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / k_count));
  EXPECT_NE(LocalRandom(5).next(), c.next());
}

}  // namespace
}  // namespace tenniel
