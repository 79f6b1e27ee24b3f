// SPDX-License-Identifier: Apache-2.0
#include "geometry/vertex_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/test_shapes.h"

namespace tenniel {
namespace {

using test::Polygons;

Vec3 cube_corner(uint32_t i) {
  return {i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f};
}

// A cube around `middle` some of whose faces are two triangles: only angles make its corners even.
Polygons cube(Vec3 middle) {
  Polygons p;
  for (uint32_t i = 0; i < 8; ++i)
    p.add_vertex(middle + cube_corner(i));
  p.add_polygon({0, 2, 3, 1});
  p.add_polygon({4, 5, 7, 6});
  p.add_polygon({0, 1, 5, 4});
  p.add_polygon({2, 6, 7});
  p.add_polygon({2, 7, 3});
  p.add_polygon({0, 4, 6});
  p.add_polygon({0, 6, 2});
  p.add_polygon({1, 3, 7, 5});
  return p;
}

TEST(VertexNormals, WeighPolygonsByTheirAngle) {
  const Polygons p = cube({});
  const auto normals = vertex_normals(p.soup());
  ASSERT_EQ(normals.size(), 8u);
  for (uint32_t i = 0; i < 8; ++i)
    EXPECT_NEAR(distance(normals[i], normalize(cube_corner(i))), 0.0f, 1e-6f) << i;
}

TEST(VertexNormals, AreAsGoodFarFromTheOrigin) {
  const Polygons p = cube({1e6f, -1e6f, 1e6f});
  const auto normals = vertex_normals(p.soup());
  for (uint32_t i = 0; i < 8; ++i)
    EXPECT_NEAR(distance(normals[i], normalize(cube_corner(i))), 0.0f, 1e-6f) << i;
}

// The four directions to the tips of a concave arrow still sum to its one plane.
TEST(VertexNormals, OfAConcavePolygonIsThatOfItsPlane) {
  Polygons p;
  for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{2, -1, 0}, Vec3{0, 3, 0}, Vec3{-2, -1, 0}})
    p.add_vertex(v);
  p.add_polygon({0, 1, 2, 3});
  for (const Vec3 n : vertex_normals(p.soup()))
    EXPECT_NEAR(distance(n, {0.0f, 0.0f, 1.0f}), 0.0f, 1e-6f);
}

TEST(VertexNormals, PointAwayFromTheOriginWhereThereIsNoPolygon) {
  Polygons p = cube({});
  p.add_vertex({0.0f, 0.0f, -3.0f});
  EXPECT_NEAR(distance(vertex_normals(p.soup())[8], {0.0f, 0.0f, -1.0f}), 0.0f, 1e-6f);
}

TEST(VertexNormals, LeaveOutWhatIsBroken) {
  Polygons p = cube({});
  p.add_vertex({std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f});
  p.add_polygon({0, 8, 7});     // a corner that is no number
  p.add_polygon({0, 1, 99});    // a vertex that is not there
  p.add_polygon({1, 1, 1});     // no area and no angle
  p.starts.push_back(1 << 30);  // corners that are not there
  p.sizes.push_back(4);
  const auto normals = vertex_normals(p.soup());
  for (uint32_t i = 2; i < 7; ++i)
    EXPECT_NEAR(distance(normals[i], normalize(cube_corner(i))), 0.0f, 1e-6f) << i;
  for (const Vec3 n : normals)
    EXPECT_TRUE(is_finite(n));
}

// Only what differs by a sum's last bits is settled.
TEST(VertexNormals, SettleTheCornersThatTheyWereTakenFor) {
  const Polygons p = cube({});
  const PolygonSoup soup = p.soup();
  const auto normals = vertex_normals(soup);
  std::vector<Vec3> corners;
  for (const uint32_t vertex : p.corner_vertices)
    corners.push_back(normals[vertex]);
  corners[0] = normalize(corners[0] + Vec3{3e-7f, 0.0f, 0.0f});
  const Vec3 bent = corners[1] = normalize(corners[1] + Vec3{3e-3f, 0.0f, 0.0f});
  settle_corner_normals(soup, normals, corners);
  EXPECT_EQ(corners[0], normals[p.corner_vertices[0]]);
  EXPECT_EQ(corners[1], bent);
}

TEST(VertexNormals, EndWhenCancelled) {
  const std::atomic<bool> flag{true};
  EXPECT_THROW(vertex_normals(cube({}).soup(), Cancellation(&flag)), Cancelled);
}

TEST(BuildMesh, MakesTheNormalsOfSmoothFaces) {
  Polygons p = cube({});
  EXPECT_TRUE(build_mesh(p.soup()).vertex_normals.empty());
  p.smooth.assign(p.starts.size(), 0);
  EXPECT_TRUE(build_mesh(p.soup()).vertex_normals.empty());
  p.smooth[3] = 1;
  EXPECT_EQ(build_mesh(p.soup()).vertex_normals, vertex_normals(p.soup()));
}

}  // namespace
}  // namespace tenniel
