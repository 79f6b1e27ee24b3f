// SPDX-License-Identifier: Apache-2.0
#include "geometry/voxel_grid.h"

#include <gtest/gtest.h>

#include <limits>

namespace tenniel {
namespace {

constexpr std::array<int, 3> k_size{4, 5, 6};

float value_at(float x, float y, float z) {
  return 1.0f + 2.0f * x - 3.0f * y + 0.5f * z;
}

// A linear function of place, at the voxels' middles.
VoxelGrid linear_grid() {
  auto values = std::make_shared<std::vector<float>>();
  for (int k = 0; k < k_size[2]; ++k)
    for (int j = 0; j < k_size[1]; ++j)
      for (int i = 0; i < k_size[0]; ++i)
        values->push_back(
            value_at((float(i) + 0.5f) / 4.0f, (float(j) + 0.5f) / 5.0f, (float(k) + 0.5f) / 6.0f));
  return {values, k_size, 1};
}

TEST(VoxelGrid, KeepsLinearFunctions) {
  const VoxelGrid grid = linear_grid();
  for (const float u : {0.4f, 0.5f, 0.55f, 0.6f}) {
    const Vec3 p{u, 0.9f * u, 1.0f - u};
    const float expected = value_at(p.x, p.y, p.z);
    EXPECT_NEAR(grid.lookup(p, GridFilter::linear)[0], expected, 1e-5f);
    EXPECT_NEAR(grid.lookup(p, GridFilter::cubic)[0], expected, 1e-5f);
  }
}

TEST(VoxelGrid, ClosestIsTheVoxelAround) {
  const VoxelGrid grid = linear_grid();
  EXPECT_FLOAT_EQ(grid.lookup({0.26f, 0.21f, 0.99f}, GridFilter::closest)[0],
                  value_at(1.5f / 4.0f, 1.5f / 5.0f, 5.5f / 6.0f));
}

TEST(VoxelGrid, GoesOnToItsBordersAndEndsThere) {
  const VoxelGrid grid = linear_grid();
  const auto corner = grid.lookup({0.0f, 0.0f, 1.0f}, GridFilter::linear);
  EXPECT_FLOAT_EQ(corner[0], value_at(0.125f, 0.1f, 5.5f / 6.0f));
  EXPECT_EQ(corner[2], corner[0]);
  EXPECT_EQ(corner[3], 1.0f);
  for (const Vec3 p : {Vec3{-0.01f, 0.5f, 0.5f}, Vec3{0.5f, 1.01f, 0.5f}, Vec3{0.5f, 0.5f, 2.0f},
                       Vec3{std::numeric_limits<float>::quiet_NaN(), 0.5f, 0.5f}})
    for (const GridFilter filter : {GridFilter::linear, GridFilter::closest, GridFilter::cubic})
      EXPECT_EQ(grid.lookup(p, filter), VoxelGrid::Rgba{});
}

TEST(VoxelGrid, DropsWhatIsNoNumber) {
  const auto values = std::make_shared<std::vector<float>>(
      std::vector<float>{1.0f, std::numeric_limits<float>::infinity(), 2.0f, 0.5f});
  const VoxelGrid grid(values, {1, 1, 1}, 4);
  EXPECT_EQ(grid.lookup({0.5f, 0.5f, 0.5f}, GridFilter::linear),
            (VoxelGrid::Rgba{1.0f, 0.0f, 2.0f, 0.5f}));
}

}  // namespace
}  // namespace tenniel
