// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/test_shapes.h"

namespace tenniel {
namespace {

using test::Polygons;

// A strip of unit squares along x.
Polygons strip(int quads) {
  Polygons p;
  for (int x = 0; x <= quads; ++x)
    for (int y = 0; y < 2; ++y)
      p.add_vertex({static_cast<float>(x), static_cast<float>(y), 0.0f});
  for (uint32_t q = 0; q < static_cast<uint32_t>(quads); ++q)
    p.add_polygon({2 * q, 2 * q + 2, 2 * q + 3, 2 * q + 1});
  return p;
}

std::array<std::array<uint32_t, 2>, 2> diagonal_pairs(const Mesh& mesh, uint32_t face) {
  const FaceTriangle a = face_triangle(mesh, face, false), b = face_triangle(mesh, face, true);
  return {{{a.corners[1], a.corners[2]}, {b.corners[2], b.corners[1]}}};
}

TEST(BuildMesh, KeepsQuadsAndBlendersDiagonal) {
  Polygons p = strip(1);
  Mesh mesh = build_mesh(p.soup());
  ASSERT_EQ(mesh.corners_per_face, 4);
  ASSERT_EQ(mesh.face_count(), 1u);
  // A fan from corner 0 splits along 0-2.
  for (const auto& pair : diagonal_pairs(mesh, 0)) {
    EXPECT_EQ(std::min(pair[0], pair[1]), 0u);
    EXPECT_EQ(std::max(pair[0], pair[1]), 2u);
  }
  p = {};
  for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
    p.add_vertex(v);
  p.add_polygon({0, 1, 2, 3}, 1);  // a fan from corner 1: along 1-3
  mesh = build_mesh(p.soup());
  for (const auto& pair : diagonal_pairs(mesh, 0)) {
    EXPECT_EQ(std::min(pair[0], pair[1]), 1u);
    EXPECT_EQ(std::max(pair[0], pair[1]), 3u);
  }
}

TEST(BuildMesh, PreservesWinding) {
  for (const int first : {0, 1}) {
    Polygons p;
    for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
      p.add_vertex(v);
    p.add_polygon({0, 1, 2, 3}, first);
    const Mesh mesh = build_mesh(p.soup());
    for (const bool second : {false, true}) {
      const FaceTriangle t = face_triangle(mesh, 0, second);
      const auto& x = mesh.positions;
      const Vec3 n =
          cross(x[t.vertices[1]] - x[t.vertices[0]], x[t.vertices[2]] - x[t.vertices[0]]);
      EXPECT_FLOAT_EQ(n.z, 1.0f);
    }
  }
}

TEST(BuildMesh, TriangulatesWhereQuadsAreFew) {
  Polygons p = strip(1);
  for (int i = 0; i < 5; ++i)
    p.add_polygon({0, 2, 3});
  const Mesh mesh = build_mesh(p.soup());
  EXPECT_EQ(mesh.corners_per_face, 3);
  EXPECT_EQ(mesh.face_count(), 7u);
  EXPECT_EQ(mesh.face_polygons[0], 0u);
  EXPECT_EQ(mesh.face_polygons[1], 0u);
  EXPECT_EQ(mesh.face_polygons[6], 5u);
}

TEST(BuildMesh, MixesTrianglesAndPolygonsIntoQuads) {
  Polygons p = strip(6);
  p.add_polygon({0, 2, 3});
  p.add_polygon({0, 2, 4, 5, 1});  // a pentagon: three triangles
  p.materials.assign(p.starts.size(), 0);
  p.materials.back() = 3;
  const Mesh mesh = build_mesh(p.soup());
  ASSERT_EQ(mesh.corners_per_face, 4);
  ASSERT_EQ(mesh.face_count(), 10u);
  EXPECT_EQ(mesh.face_vertices[6 * 4 + 2], mesh.face_vertices[6 * 4 + 3]);
  EXPECT_EQ(mesh.face_polygons[9], 7u);
  EXPECT_EQ(mesh.material_slot(9), 3);
  EXPECT_EQ(mesh.material_slot(5), 0);
}

TEST(BuildMesh, EndsWhenCancelled) {
  const Polygons p = strip(1);
  std::atomic<bool> flag{false};
  const Cancellation cancellation(&flag);
  Mesh mesh = build_mesh(p.soup(), cancellation);
  const Attribute uv{"uv", AttributeDomain::vertex, 2, {0, 0, 0, 1, 1, 0, 1, 1}};
  add_tangents(mesh, uv, "tangent", cancellation);
  EXPECT_EQ(mesh.attributes.size(), 2u);
  flag = true;
  EXPECT_THROW(build_mesh(p.soup(), cancellation), Cancelled);
  EXPECT_THROW(add_tangents(mesh, uv, "other", cancellation), Cancelled);
  EXPECT_EQ(mesh.attributes.size(), 2u);
}

TEST(BuildMesh, OmitsArraysThatSayNothing) {
  Polygons p = strip(3);
  p.materials.assign(3, 0);
  p.smooth.assign(3, 1);
  const Mesh mesh = build_mesh(p.soup());
  EXPECT_TRUE(mesh.face_polygons.empty());
  EXPECT_TRUE(mesh.face_materials.empty());
  EXPECT_TRUE(mesh.face_smooth.empty());
  EXPECT_TRUE(mesh.is_smooth(2));
}

TEST(BuildMesh, DropsFacesItCannotUse) {
  Polygons p = strip(6);
  p.positions[3 * 12] = std::nanf("");                               // of quad 5
  p.positions[3 * 13 + 1] = std::numeric_limits<float>::infinity();  // of quad 5 too
  p.corner_vertices[0] = 4000000000u;                                // quad 0
  p.starts[1] = -3;
  p.sizes[2] = 1000000;
  p.sizes[3] = 2;
  const Mesh mesh = build_mesh(p.soup());
  EXPECT_EQ(mesh.dropped_faces, 5u);
  ASSERT_EQ(mesh.face_count(), 1u);
  ASSERT_EQ(mesh.face_polygons.size(), 1u);
  EXPECT_EQ(mesh.face_polygons[0], 4u);
  const Bounds3 box = mesh.bounds();
  EXPECT_EQ(box.min, (Vec3{4, 0, 0}));
  EXPECT_EQ(box.max, (Vec3{5, 1, 0}));
}

TEST(BuildMesh, SurvivesExtremeSizesAndLies) {
  Polygons p = strip(2);
  p.sizes[0] = std::numeric_limits<int32_t>::min();
  p.starts[1] = std::numeric_limits<int32_t>::max();
  EXPECT_EQ(build_mesh(p.soup()).dropped_faces, 2u);

  p = strip(2);
  for (uint32_t& c : p.triangle_corners)
    c = 77777;
  EXPECT_EQ(build_mesh(p.soup()).face_count(), 2u) << "a wrong triangulation leaves the fan";
  p.triangle_corners.clear();
  p.add_polygon({0, 2, 4, 5, 1});
  p.triangle_corners.clear();
  EXPECT_EQ(build_mesh(p.soup()).dropped_faces, 0u);

  EXPECT_EQ(build_mesh(PolygonSoup()).face_count(), 0u);
  EXPECT_TRUE(build_mesh(PolygonSoup()).bounds().is_empty());
}

TEST(BuildMesh, LeavesRoomBehindTheLastVertexForEmbree) {
  const Mesh mesh = build_mesh(strip(2).soup());
  EXPECT_GT(mesh.positions.capacity(), mesh.positions.size());
}

TEST(MoveToWorldSpace, CarriesNormalsByTheInverseTranspose) {
  Mesh mesh = test::sphere(1.0f);
  const Transform squash{{-2, 0, 0}, {0, 1, 0}, {0, 0, 0.5f}, {1, 2, 3}};
  const Vec3 n = mesh.vertex_normals[40];
  move_to_world_space(mesh, squash);
  EXPECT_TRUE(mesh.flips_winding);
  const Vec3 expected = normalize(Vec3{n.x / -2.0f, n.y, n.z / 0.5f});
  EXPECT_NEAR(distance(mesh.vertex_normals[40], expected), 0.0f, 1e-6f);
}

TEST(AttributeIds, NumbersNamesOnce) {
  AttributeIds ids;
  EXPECT_EQ(ids.intern("UVMap"), 0);
  EXPECT_EQ(ids.intern("Col"), 1);
  EXPECT_EQ(ids.intern("UVMap"), 0);
  EXPECT_EQ(ids.find("Col"), 1);
  EXPECT_EQ(ids.find("none"), AttributeIds::k_none);
  EXPECT_EQ(ids.count(), 2);
}

// A 2x1 strip with smooth normals up and UV = position, or mirrored beyond x = 1.
Mesh mapped_strip(bool is_mirrored, Attribute& uv) {
  Polygons p = strip(2);
  p.smooth.assign(2, 1);
  for (size_t i = 0; i < p.positions.size() / 3; ++i)
    p.vertex_normals.insert(p.vertex_normals.end(), {0.0f, 0.0f, 1.0f});
  uv = {"UVMap", AttributeDomain::corner, 2, {}};
  for (const uint32_t v : p.corner_vertices) {
    const float x = p.positions[3 * v];
    uv.data.push_back(is_mirrored && x > 1.0f ? 2.0f - x : x);
    uv.data.push_back(p.positions[3 * v + 1]);
  }
  return build_mesh(p.soup());
}

TEST(Tangents, FollowUOnAMappedQuad) {
  Attribute uv;
  Mesh mesh = mapped_strip(false, uv);
  add_tangents(mesh, uv, "tangent");
  ASSERT_EQ(mesh.attributes.size(), 2u);
  EXPECT_EQ(mesh.attributes[1].name, "tangent.sign");
  for (size_t c = 0; c < 8; ++c) {
    EXPECT_NEAR(mesh.attributes[0].data[3 * c], 1.0f, 1e-6f);
    EXPECT_NEAR(mesh.attributes[0].data[3 * c + 1], 0.0f, 1e-6f);
    EXPECT_EQ(mesh.attributes[1].data[c], 1.0f);
  }
}

// The shared edge has equal positions, normals and UVs on both sides, yet must not be averaged.
TEST(Tangents, KeepMirroredUVsApart) {
  Attribute uv;
  Mesh mesh = mapped_strip(true, uv);
  add_tangents(mesh, uv, "tangent");
  for (size_t c = 0; c < 8; ++c) {
    const float side = c < 4 ? 1.0f : -1.0f;
    EXPECT_NEAR(mesh.attributes[0].data[3 * c], side, 1e-6f) << c;
    EXPECT_EQ(mesh.attributes[1].data[c], side) << c;
  }
}

// Around a smooth fold the tangents of both sides meet half way, in the plane of the normal.
TEST(Tangents, AverageOverASmoothEdge) {
  Polygons p;
  for (const Vec3 v : {Vec3{-1, 0, 0}, Vec3{-1, 1, 0}, Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1},
                       Vec3{0, 1, -1}})
    p.add_vertex(v);
  p.add_polygon({0, 2, 3, 1});
  p.add_polygon({2, 4, 5, 3});
  p.smooth.assign(2, 1);
  const float h = std::sqrt(0.5f);
  p.vertex_normals = {0, 0, 1, 0, 0, 1, h, 0, h, h, 0, h, 1, 0, 0, 1, 0, 0};
  Attribute uv{"UVMap", AttributeDomain::vertex, 2, {0, 0, 0, 1, 1, 0, 1, 1, 2, 0, 2, 1}};
  Mesh mesh = build_mesh(p.soup());
  add_tangents(mesh, uv, "t");
  const float* at_fold = &mesh.attributes[0].data[3];  // corner 1 = vertex 2
  EXPECT_NEAR(distance({at_fold[0], at_fold[1], at_fold[2]}, {h, 0, -h}), 0.0f, 1e-5f);
  EXPECT_NEAR(mesh.attributes[0].data[0], 1.0f, 1e-6f);
}

// A smooth fan whose third triangle is mapped mirrored; tangents by Blender 3.4's calc_tangents(),
// which weighs by an approximate arc cosine.
TEST(Tangents, AgreeWithBlender) {
  Polygons p;
  p.positions = {0, 0, 0.5f, 1, 0.1f, 0, 0.2f, 1.1f, 0, -0.9f, 0.1f, 0.1f, 0, -1.2f, 0};
  for (const uint32_t i : {1u, 2u, 3u, 4u})
    p.add_polygon({0, i, i % 4 + 1});
  p.smooth.assign(4, 1);
  p.vertex_normals = {0.0053353f, -0.0059549f, 0.999968f,  0.4460809f,  0.013635f,
                      0.8948888f, 0.0885836f,  0.3987833f, 0.9127568f,  -0.4012112f,
                      0.0480058f, 0.9147266f,  0.0447839f, -0.3842295f, 0.9221508f};
  const Vec2 uvs[] = {{0.5f, 0.5f}, {1.0f, 0.45f}, {0.6f, 0.9f}, {0.1f, 0.4f}, {0.45f, 0.05f}};
  Attribute uv{"UV", AttributeDomain::corner, 2, {}};
  for (size_t c = 0; c < 12; ++c) {
    const Vec2 at = uvs[p.corner_vertices[c]];
    uv.data.push_back(c / 3 == 2 ? 1.0f - at.x : at.x);
    uv.data.push_back(at.y);
  }
  const Vec3 center{0.999986f, -0.000192f, -0.005337f}, first{0.874994f, 0.203546f, -0.439265f};
  const Vec3 second{0.995823f, -0.055825f, -0.072255f};
  const Vec3 expected[] = {center,
                           first,
                           second,
                           center,
                           second,
                           {0.847587f, -0.359189f, 0.390614f},
                           {-0.926471f, 0.376297f, 0.007184f},
                           {-0.847833f, 0.358529f, -0.390687f},
                           {-0.967296f, 0.214014f, 0.136149f},
                           center,
                           {0.998052f, 0.057337f, -0.024580f},
                           first};
  Mesh mesh = build_mesh(p.soup());
  add_tangents(mesh, uv, "t");
  for (size_t c = 0; c < 12; ++c) {
    const float* t = &mesh.attributes[0].data[3 * c];
    EXPECT_NEAR(distance({t[0], t[1], t[2]}, expected[c]), 0.0f, 2e-5f) << c;
    EXPECT_EQ(mesh.attributes[1].data[c], c / 3 == 2 ? -1.0f : 1.0f) << c;
  }
}

TEST(Tangents, SurviveUselessUVs) {
  Attribute uv;
  Mesh mesh = mapped_strip(false, uv);
  std::fill(uv.data.begin(), uv.data.begin() + 8, 0.25f);  // first quad: no area
  uv.data[9] = std::nanf("");
  add_tangents(mesh, uv, "t");
  for (const Attribute& a : mesh.attributes)
    for (const float x : a.data)
      EXPECT_TRUE(std::isfinite(x));
}

TEST(Tangents, LieInTheSurfaceOfASphere) {
  Mesh mesh = test::sphere(2.0f, 12, 24);
  Attribute uv{"UVMap", AttributeDomain::vertex, 2, {}};
  for (const Vec3 p : mesh.positions) {
    uv.data.push_back(p.x);
    uv.data.push_back(p.y);
  }
  add_tangents(mesh, uv, "t");
  for (size_t i = 0; i < mesh.face_corners.size(); ++i) {
    const float* t = &mesh.attributes[0].data[3 * mesh.face_corners[i]];
    const Vec3 tangent{t[0], t[1], t[2]};
    EXPECT_NEAR(length(tangent), 1.0f, 1e-5f);
    EXPECT_NEAR(dot(tangent, mesh.vertex_normals[mesh.face_vertices[i]]), 0.0f, 1e-4f);
    const float z = mesh.positions[mesh.face_vertices[i]].z;
    if (std::abs(z) > 0.1f) {
      EXPECT_GT(tangent.x, 0.0f);
    }
  }
}

}  // namespace
}  // namespace tenniel
