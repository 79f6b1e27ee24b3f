// SPDX-License-Identifier: Apache-2.0
#include "geometry/pointiness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/numeric.h"

namespace tenniel {
namespace {

TEST(Pointiness, OfAFlatSheetIsOneHalf) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> up(4, Vec3{0, 0, 1});
  for (const float p : pointiness(square, up, {0, 1, 1, 2, 2, 3, 3, 0}))
    EXPECT_NEAR(p, 0.5f, 1e-6f);
}

// A corner of a cube: the edges lie acos(-1 / sqrt(3)) off the normal, their mean is 1 / sqrt(3)
// long.
TEST(Pointiness, OfACubeIsThatOfItsCorners) {
  std::vector<Vec3> corners, normals;
  std::vector<uint32_t> edges;
  for (uint32_t i = 0; i < 8; ++i) {
    const auto sign = [i](uint32_t bit) { return i & bit ? 1.0f : -1.0f; };
    corners.push_back({sign(1), sign(2), sign(4)});
    normals.push_back(normalize(corners.back()));
    for (const uint32_t bit : {1u, 2u, 4u})
      if (!(i & bit)) edges.insert(edges.end(), {i, i | bit});
  }
  const float expected = std::acos(-1.0f / std::sqrt(3.0f)) * k_inv_pi;
  for (const float p : pointiness(corners, normals, edges))
    EXPECT_NEAR(p, expected, 1e-5f);
}

TEST(Pointiness, EndsWhenCancelled) {
  const std::atomic<bool> flag{true};
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 0, 0}}, up(2, Vec3{0, 0, 1});
  EXPECT_THROW(pointiness(line, up, {0, 1}, Cancellation(&flag)), Cancelled);
}

TEST(Pointiness, SeesSplitVerticesAsOne) {
  // A ridge whose two flanks do not share their vertices.
  const std::vector<Vec3> whole = {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 1}};
  const std::vector<Vec3> split = {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 0, 1}};
  const std::vector<Vec3> normals(5, Vec3{0, 0, 1});
  const auto a = pointiness(whole, {normals.begin(), normals.begin() + 4}, {0, 1, 1, 2, 1, 3});
  const auto b = pointiness(split, normals, {0, 1, 4, 2, 1, 3});
  for (size_t v = 0; v < 4; ++v)
    EXPECT_NEAR(a[v], b[v], 1e-6f);
  EXPECT_EQ(b[1], b[4]);
  std::vector<Vec3> apart = split;
  apart[4].x += 0.01f;
  EXPECT_NE(pointiness(apart, normals, {0, 1, 4, 2, 1, 3})[1], a[1]);
}

}  // namespace
}  // namespace tenniel
