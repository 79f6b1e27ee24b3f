// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <gtest/gtest.h>

#include <set>

namespace tenniel {
namespace {

TEST(Film, TilesCoverEveryPixelOnce) {
  const Film film(37, 21);
  std::set<std::pair<int, int>> seen;
  for (const FilmRect& tile : film.tiles())
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x)
        EXPECT_TRUE(seen.insert({tile.x + x, tile.y + y}).second);
  EXPECT_EQ(seen.size(), 37u * 21u);
  EXPECT_EQ(seen.rbegin()->first, 36);
}

TEST(Film, AveragesSamplesAndKeepsTheFirstDepth) {
  Film film(20, 20);
  for (size_t i = 0; i < film.tiles().size(); ++i) {
    TileSums sums = film.read_tile(i);
    for (PixelSums& pixel : sums.pixels) {
      pixel.add({Spectrum(1.0f, 2.0f, 3.0f), 0.0f, 5.0f, {0.0f, 0.0f, 1.0f}, 0, {}});
      pixel.add({Spectrum(3.0f, 2.0f, 1.0f),
                 0.5f,
                 9.0f,
                 {0.0f, 1.0f, 0.0f},
                 2,
                 Spectrum(1.0f, 0.0f, 0.0f)});
    }
    film.write_tile(i, sums);
  }
  const FilmRect rect{15, 14, 3, 4};  // across four tiles
  std::vector<float> combined(3 * 4 * 4), depth(3 * 4), normal(3 * 4 * 3);
  film.read(k_passes[0], rect, 2.0f, combined.data());
  film.read(k_passes[1], rect, 2.0f, depth.data());
  film.read(k_passes[2], rect, 2.0f, normal.data());
  std::vector<float> dream(3 * 4), coverage(3 * 4), dream_radiance(3 * 4 * 3);
  film.read(k_passes[3], rect, 2.0f, dream.data());
  film.read(k_passes[4], rect, 2.0f, coverage.data());
  film.read(k_passes[5], rect, 2.0f, dream_radiance.data());
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_FLOAT_EQ(combined[4 * i], 4.0f);
    EXPECT_FLOAT_EQ(combined[4 * i + 2], 4.0f);
    EXPECT_FLOAT_EQ(combined[4 * i + 3], 0.75f);
    EXPECT_FLOAT_EQ(depth[i], 5.0f);
    EXPECT_FLOAT_EQ(normal[3 * i + 1], 0.5f);
    EXPECT_FLOAT_EQ(dream[i], 2.0f);
    EXPECT_FLOAT_EQ(coverage[i], 0.5f);
    EXPECT_FLOAT_EQ(dream_radiance[3 * i], 1.0f);
  }
}

TEST(Film, AveragesExtraChannels) {
  Film film(20, 20, 3);
  for (size_t i = 0; i < film.tiles().size(); ++i) {
    TileSums sums = film.read_tile(i);
    ASSERT_EQ(sums.extra.size(), 3 * sums.pixels.size());
    for (size_t p = 0; p < sums.pixels.size(); ++p) {
      sums.pixels[p].add({});
      sums.pixels[p].add({});
      const auto tile = static_cast<float>(i);
      for (size_t c = 0; c < 3; ++c)
        sums.extra[3 * p + c] += 10.0f * tile + static_cast<float>(c);
    }
    film.write_tile(i, sums);
  }
  for (size_t i = 0; i < film.tiles().size(); ++i) {
    const FilmRect& tile = film.tiles()[i];
    const size_t count = static_cast<size_t>(tile.width) * static_cast<size_t>(tile.height);
    std::vector<float> last_two(2 * count);
    film.read_extra(1, 2, tile, last_two.data());
    for (size_t p = 0; p < 2 * count; ++p)
      EXPECT_FLOAT_EQ(last_two[p],
                      5.0f * static_cast<float>(i) + 0.5f * static_cast<float>(1 + p % 2));
  }
}

TEST(Film, PixelsWithoutSamplesAreTransparentBlack) {
  const Film film(4, 4);
  std::vector<float> combined(4 * 4 * 4, 7.0f);
  film.read(k_passes[0], {0, 0, 4, 4}, 1.0f, combined.data());
  for (const float v : combined)
    EXPECT_EQ(v, 0.0f);
}

}  // namespace
}  // namespace tenniel
