// SPDX-License-Identifier: Apache-2.0
#include "scene/displace.h"

#include <gtest/gtest.h>

#include "scene/compile_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr int k_cells = 8;

// Smooth grid of side 2 in the xy plane.
MeshDesc grid() {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<uint32_t>> polygons;
  for (int j = 0; j <= k_cells; ++j)
    for (int i = 0; i <= k_cells; ++i)
      vertices.push_back({2.0f * static_cast<float>(i) / k_cells - 1.0f,
                          2.0f * static_cast<float>(j) / k_cells - 1.0f, 0.0f});
  const auto at = [](int i, int j) { return static_cast<uint32_t>(j * (k_cells + 1) + i); };
  for (int j = 0; j < k_cells; ++j)
    for (int i = 0; i < k_cells; ++i)
      polygons.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  MeshDesc mesh = mesh_of(vertices, polygons);
  mesh.smooth_flags = buffer(std::vector<uint8_t>(polygons.size(), 1));
  std::vector<float> up;
  for (size_t i = 0; i < vertices.size(); ++i)
    up.insert(up.end(), {0.0f, 0.0f, 1.0f});
  mesh.vertex_normals = buffer(std::move(up));
  return mesh;
}

// Diffuse, with the height (x of the object's coordinate, put through `operation`) - 0.5, times 3.
NodeGraph hilly(const std::string& operation, float operand, const std::string& space = "OBJECT") {
  GraphBuilder g("hilly");
  g.surface(g.add("ShaderNodeBsdfDiffuse"));
  const uint32_t coordinate = g.add("ShaderNodeTexCoord");
  const uint32_t separate = g.add("ShaderNodeSeparateXYZ");
  const uint32_t math =
      g.add("ShaderNodeMath", {{"Value_001", {operand}}}, {{"operation", operation}});
  const uint32_t displacement = g.add(
      "ShaderNodeDisplacement", {{"Midlevel", {0.5f}}, {"Scale", {3.0f}}}, {{"space", space}});
  g.link(coordinate, "Object", separate, "Vector").link(separate, "X", math, "Value");
  g.link(math, "Value", displacement, "Height")
      .link(displacement, "Displacement", 0, "Displacement");
  return g.build();
}

struct Displaced {
  std::shared_ptr<const Scene> scene;
  std::vector<Diagnostic> reports;
  const Mesh& mesh() const { return scene->meshes[0]; }
};

Displaced compiled(NodeGraph graph, const std::string& method,
                   const Matrix34& matrix = k_identity34) {
  SceneBuilder b;
  b.object(grid(), std::move(graph), matrix);
  b.scene.materials[0].displacement_method = method;
  Diagnostics diagnostics;
  Displaced result;
  result.scene = compile_scene(std::move(b.scene), diagnostics, {});
  result.reports = diagnostics.take();
  return result;
}

void expect_heights(const Mesh& mesh, float slope, float offset) {
  for (const Vec3 p : mesh.positions)
    EXPECT_NEAR(p.z, slope * p.x + offset, 1e-5f);
}

TEST(Displace, MovesVerticesAlongTheirNormals) {
  const Displaced d = compiled(hilly("MULTIPLY", 0.25f), "DISPLACEMENT");
  expect_heights(d.mesh(), 0.75f, -1.5f);
  EXPECT_TRUE(d.reports.empty());
  const auto hit = d.scene->accel->intersect(Ray{{0.5f, 0.1f, 10.0f}, {0, 0, -1}}, ~0u);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 10.0f - (0.75f * 0.5f - 1.5f), 1e-5f);
}

TEST(Displace, BumpMovesNothing) {
  const Displaced d = compiled(hilly("MULTIPLY", 0.25f), "BUMP");
  expect_heights(d.mesh(), 0.0f, 0.0f);
  EXPECT_TRUE(d.mesh().undisplaced.empty());
}

TEST(Displace, NormalsFollowUnlessBumpStaysOnTop) {
  const Vec3 tilted = normalize(Vec3{-0.75f, 0.0f, 1.0f});
  for (const auto& [method, normal] :
       {std::pair{"DISPLACEMENT", tilted}, {"BOTH", Vec3{0.0f, 0.0f, 1.0f}}}) {
    const Displaced d = compiled(hilly("MULTIPLY", 0.25f), method);
    expect_heights(d.mesh(), 0.75f, -1.5f);
    for (const Vec3 n : d.mesh().vertex_normals)
      EXPECT_LT(length(n - normal), 1e-5f) << method;
  }
}

TEST(Displace, ScaledObjectsMoveInTheirOwnSpaceOrInTheWorlds) {
  const Matrix34 tall{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0};
  for (const auto& [space, factor] : {std::pair{"OBJECT", 2.0f}, {"WORLD", 1.0f}}) {
    const Displaced d = compiled(hilly("MULTIPLY", 0.25f, space), "DISPLACEMENT", tall);
    EXPECT_TRUE(d.mesh().is_world_space);
    expect_heights(d.mesh(), 0.75f * factor, -1.5f * factor);
  }
}

TEST(Displace, ObjectsWithoutVolumeStayFinite) {
  for (const Matrix34& matrix : {Matrix34{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, Matrix34{}}) {
    const Displaced d = compiled(hilly("MULTIPLY", 0.25f), "DISPLACEMENT", matrix);
    for (const Vec3 p : d.mesh().positions)
      EXPECT_TRUE(is_finite(p));
    for (const Vec3 n : d.mesh().vertex_normals)
      EXPECT_TRUE(is_finite(n));
  }
}

TEST(Displace, WhatIsNotFiniteStaysWithAReport) {
  // Beyond the range of float, or so far that its square is, wherever x is not 0.
  const Displaced d = compiled(hilly("MULTIPLY", 3e38f), "DISPLACEMENT");
  size_t moved = 0;
  for (const Vec3 p : d.mesh().positions) {
    EXPECT_TRUE(is_finite(p));
    moved += p.z != 0.0f;
  }
  EXPECT_EQ(moved, size_t{k_cells + 1});  // the column at x = 0
  ASSERT_EQ(d.reports.size(), 1u);
  EXPECT_NE(d.reports[0].text.find("72 vertices"), std::string::npos) << d.reports[0].text;
}

TEST(Displace, InstancesShareOneDisplacedMesh) {
  SceneBuilder b;
  b.object(grid(), hilly("MULTIPLY", 0.25f));
  b.instance(0, 0, {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0});
  b.scene.materials[0].displacement_method = "DISPLACEMENT";
  Diagnostics diagnostics;
  const auto scene = compile_scene(std::move(b.scene), diagnostics, {});
  EXPECT_FALSE(scene->meshes[0].is_world_space);
  expect_heights(scene->meshes[0], 0.75f, -1.5f);
}

TEST(Displace, SharedMeshesWithOtherMaterialsAreReported) {
  SceneBuilder b;
  b.object(grid(), hilly("MULTIPLY", 0.25f)).name = "first";
  b.scene.materials[0].displacement_method = "DISPLACEMENT";
  b.instance(0, b.material(diffuse(0.5f)), k_identity34);
  Diagnostics diagnostics;
  compile_scene(std::move(b.scene), diagnostics, {});
  const std::vector<Diagnostic> reports = diagnostics.take();
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].object, "first");
}

TEST(Displace, APlainVectorMovesInTheWorld) {
  GraphBuilder g("pushed");
  g.surface(g.add("ShaderNodeBsdfDiffuse"));
  const uint32_t combine =
      g.add("ShaderNodeCombineXYZ", {{"X", {0.25f}}, {"Y", {0.0f}}, {"Z", {1.0f}}});
  g.link(combine, "Vector", 0, "Displacement");
  const Displaced d = compiled(g.build(), "DISPLACEMENT", {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0});
  expect_heights(d.mesh(), 0.0f, 1.0f);
  float right = 0.0f;
  for (const Vec3 p : d.mesh().positions)
    right = std::max(right, p.x);
  EXPECT_NEAR(right, 1.25f, 1e-5f);
}

}  // namespace
}  // namespace tenniel
