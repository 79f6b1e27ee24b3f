// SPDX-License-Identifier: Apache-2.0
#include "image/voxel_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/ray.h"

namespace tenniel {
namespace {

constexpr std::array<int, 3> k_size{4, 5, 6};

float value_at(float x, float y, float z) {
  return 1.0f + 2.0f * x - 3.0f * y + 0.5f * z;
}

// A linear function of place, at the voxels' middles.
VoxelGrid linear_grid() {
  std::vector<float> values;
  for (int k = 0; k < k_size[2]; ++k)
    for (int j = 0; j < k_size[1]; ++j)
      for (int i = 0; i < k_size[0]; ++i)
        values.push_back(
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

// One voxel of 2 in each corner brick but the first, the rest is empty.
VoxelGrid sparse_grid() {
  VoxelGrid grid({20, 9, 17}, 1, GridBorder::empty);
  std::vector<float> brick(VoxelGrid::k_brick_voxels);
  brick[0] = 2.0f;
  for (const int x : {0, 2})
    for (const int y : {0, 1})
      for (const int z : {0, 2})
        if (x + y + z > 0) grid.set_brick({x, y, z}, brick.data());
  grid.finish();
  return grid;
}

TEST(VoxelGrid, BricksAreWhereTheyBelong) {
  const VoxelGrid grid = sparse_grid();
  float sum = 0.0f;
  for (int z = 0; z < 17; ++z)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 20; ++x) {
        const Vec3 p{(float(x) + 0.5f) / 20.0f, (float(y) + 0.5f) / 9.0f,
                     (float(z) + 0.5f) / 17.0f};
        const float value = grid.lookup(p, GridFilter::closest)[0];
        const bool is_set = x % 16 == 0 && y % 8 == 0 && z % 16 == 0 && x + y + z > 0;
        EXPECT_EQ(value, is_set ? 2.0f : 0.0f) << x << " " << y << " " << z;
        EXPECT_NEAR(grid.lookup(p, GridFilter::linear)[0], value, 1e-5f);
        sum += value;
      }
  EXPECT_EQ(sum, 14.0f);
}

TEST(VoxelGrid, EmptySpaceCostsNothing) {
  VoxelGrid empty({800, 800, 800}, 1, GridBorder::empty);
  empty.finish();
  EXPECT_LT(empty.memory_bytes(), size_t{16} << 20);
  EXPECT_LT(sparse_grid().memory_bytes(), size_t{8 * 9 * 9 * 9 * sizeof(float)} + 1000);
}

// A smooth function, linear lookups compared with the eight voxels around.
TEST(VoxelGrid, LinearAcrossBricks) {
  constexpr std::array<int, 3> k_n{19, 24, 9};
  const auto value = [](int x, int y, int z) {
    return std::sin(0.3f * float(x)) + 0.2f * float(y % 7) - 0.1f * float(z * z);
  };
  std::vector<float> values;
  for (int z = 0; z < k_n[2]; ++z)
    for (int y = 0; y < k_n[1]; ++y)
      for (int x = 0; x < k_n[0]; ++x)
        values.push_back(value(x, y, z));
  const VoxelGrid grid(values, k_n, 1);
  for (int z = 0; z + 1 < k_n[2]; ++z)
    for (int y = 0; y + 1 < k_n[1]; ++y)
      for (int x = 0; x + 1 < k_n[0]; ++x) {
        float mean = 0.0f;
        for (int corner = 0; corner < 8; ++corner)
          mean += 0.125f * value(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
        const Vec3 p{(float(x) + 1.0f) / 19.0f, (float(y) + 1.0f) / 24.0f,
                     (float(z) + 1.0f) / 9.0f};
        EXPECT_NEAR(grid.lookup(p, GridFilter::linear)[0], mean, 1e-4f)
            << x << " " << y << " " << z;
      }
}

TEST(VoxelGrid, KnowsHowFarItIsEmpty) {
  VoxelGrid grid({80, 16, 16}, 1, GridBorder::empty);
  std::vector<float> brick(VoxelGrid::k_brick_voxels, 1.0f);
  grid.set_brick({6, 0, 1}, brick.data());
  grid.finish();
  const auto until = [&](Vec3 p, Vec3 d) { return 80.0f * grid.empty_until(p, d); };
  // What is looked up reaches half a voxel.
  const float far = until({0.05f, 0.25f, 0.75f}, {1.0f, 0.0f, 0.0f});
  EXPECT_NEAR(far, 47.5f - 4.0f, 1e-3f);
  EXPECT_EQ(until({0.65f, 0.25f, 0.75f}, {1.0f, 0.0f, 0.0f}), 0.0f);
  EXPECT_NEAR(until({-0.5f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}), 39.5f, 1e-3f);
  EXPECT_EQ(until({-0.5f, 0.5f, 0.5f}, {-1.0f, 0.0f, 0.0f}), k_infinity);
  EXPECT_EQ(until({-0.5f, 3.5f, 0.5f}, {1.0f, 0.0f, 0.0f}), k_infinity);
  // Nothing is found where nothing shall be.
  for (float x = -0.2f; x < 1.2f; x += 0.013f)
    for (const Vec3 d : {Vec3{1, 0.3f, 0.2f}, Vec3{-1, 0.1f, 0.4f}, Vec3{0.2f, 1, -0.6f}}) {
      const Vec3 p{x, 0.3f, 0.6f};
      const float end = std::min(grid.empty_until(p, d), 3.0f);
      for (float t = 0.0f; t < end; t += 0.002f)
        ASSERT_EQ(grid.lookup(p + d * t, GridFilter::linear)[0], 0.0f) << x << " " << t;
    }
}

TEST(VoxelGrid, FadesAtAnEmptyBorder) {
  VoxelGrid grid({8, 8, 8}, 1, GridBorder::empty);
  grid.set_brick({0, 0, 0}, std::vector<float>(VoxelGrid::k_brick_voxels, 1.0f).data());
  grid.finish();
  const auto at = [&](float voxels) {
    return grid.lookup({voxels / 8.0f, 0.5f, 0.5f}, GridFilter::linear)[0];
  };
  EXPECT_FLOAT_EQ(at(7.5f), 1.0f);
  EXPECT_FLOAT_EQ(at(8.0f), 0.5f);
  EXPECT_FLOAT_EQ(at(8.25f), 0.25f);
  EXPECT_FLOAT_EQ(at(-0.25f), 0.25f);
  EXPECT_EQ(at(8.5f), 0.0f);
  EXPECT_EQ(at(-1e9f), 0.0f);
  EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), 0.0f);
}

TEST(VoxelGrid, DropsWhatIsNoNumber) {
  const std::vector<float> values{1.0f, std::numeric_limits<float>::infinity(), 2.0f, 0.5f};
  const VoxelGrid grid(values, {1, 1, 1}, 4);
  EXPECT_EQ(grid.lookup({0.5f, 0.5f, 0.5f}, GridFilter::linear),
            (VoxelGrid::Rgba{1.0f, 0.0f, 2.0f, 0.5f}));
}

}  // namespace
}  // namespace tenniel
