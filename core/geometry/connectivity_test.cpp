// SPDX-License-Identifier: Apache-2.0
#include "geometry/connectivity.h"

#include <gtest/gtest.h>

namespace tenniel {
namespace {

TEST(ConnectedParts, HaveOneVertexEach) {
  // A path 0-1-2, a pair 3-4 and a lone vertex; the last edge does not exist.
  const auto parts = connected_parts(6, {1, 0, 1, 2, 4, 3, 5, 77});
  EXPECT_EQ(parts, (std::vector<uint32_t>{1, 1, 1, 4, 4, 5}));
}

TEST(ConnectedParts, TheDeeperSideStays) {
  // 0 holds two vertices when the single 2 comes: 0 stays although 2 is named first.
  EXPECT_EQ(connected_parts(3, {0, 1, 2, 1}), (std::vector<uint32_t>{0, 0, 0}));
}

TEST(EdgesToVertices, TakesTheMeanOfTheEdgesThatEnd) {
  const auto values = edges_to_vertices(4, {0, 1, 1, 2}, {1.0f, 10.0f, 3.0f, 30.0f}, 2);
  EXPECT_EQ(values, (std::vector<float>{1, 10, 2, 20, 3, 30, 0, 0}));
}

}  // namespace
}  // namespace tenniel
