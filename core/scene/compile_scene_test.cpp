// SPDX-License-Identifier: Apache-2.0
#include "scene/compile_scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

struct Compiled {
  std::shared_ptr<const Scene> scene;
  std::vector<Diagnostic> reports;

  bool reports_on(const std::string& object, const std::string& part) const {
    for (const Diagnostic& d : reports)
      if (d.object == object && d.text.find(part) != std::string::npos) return true;
    return false;
  }
};

Compiled compile(SceneDescription description) {
  Diagnostics diagnostics;
  Compiled result;
  result.scene = compile_scene(std::move(description), diagnostics, {});
  result.reports = diagnostics.take();
  return result;
}

TEST(CompileScene, NothingAtAllIsABlackWorld) {
  const Compiled c = compile({});
  ASSERT_TRUE(c.scene);
  EXPECT_TRUE(c.reports.empty());
  EXPECT_FALSE(c.scene->accel->intersect(Ray{{0, 0, 0}, {0, 0, 1}}, ~0u));
}

TEST(CompileScene, SingleUserMeshIsFlattenedSharedOneIsInstanced) {
  SceneBuilder b;
  b.object(square(), diffuse(0.8f), at(1.0f, 2.0f, 3.0f));
  b.object(square(), diffuse(0.8f), at(0.0f, 0.0f, 9.0f));
  b.instance(1, 0, at(5.0f, 0.0f, 9.0f));
  const Compiled c = compile(b.scene);
  EXPECT_TRUE(c.scene->meshes[0].is_world_space);
  EXPECT_FALSE(c.scene->meshes[1].is_world_space);
  const Ray down{{1.5f, 2.5f, 10.0f}, {0.0f, 0.0f, -1.0f}};
  const auto hit = c.scene->accel->intersect(down, ~0u);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->instance, 0u);
  EXPECT_NEAR(hit->t, 7.0f, 1e-5f);
  const auto second = c.scene->accel->intersect(Ray{{5.5f, 0.0f, 20.0f}, {0, 0, -1}}, ~0u);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->instance, 2u);
}

TEST(CompileScene, BrokenPlacesAndIndicesAreLeftOutWithAReport) {
  SceneBuilder b;
  b.object(square(), diffuse(0.8f)).object_to_world[3] = k_nan;
  b.scene.instances[0].name = "lost";
  b.object(square(), diffuse(0.8f)).mesh = 77;
  b.object(square(), diffuse(0.8f)).materials = {12345, -1};
  const Compiled c = compile(b.scene);
  EXPECT_TRUE(c.reports_on("lost", "not a number"));
  ASSERT_EQ(c.scene->instances.size(), 1u);
  EXPECT_EQ(c.scene->instances[0].materials[0], c.scene->materials.size() - 1);
}

TEST(CompileScene, BrokenFacesAreDroppedTheRestStays) {
  SceneBuilder b;
  MeshDesc mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {k_nan, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 99}});
  mesh.name = "torn";
  b.object(std::move(mesh), diffuse(0.8f));
  const Compiled c = compile(b.scene);
  EXPECT_EQ(c.scene->meshes[0].face_count(), 1u);
  EXPECT_TRUE(c.reports_on("torn", "2 faces"));
  EXPECT_TRUE(c.scene->accel->intersect(Ray{{0.2f, 0.2f, 1}, {0, 0, -1}}, ~0u));
}

TEST(CompileScene, FlatAndMirroredObjectsAreFine) {
  SceneBuilder b;
  b.object(square(), diffuse(0.8f), {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  b.object(square(), diffuse(0.8f), {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  const Compiled c = compile(b.scene);
  const Ray down{{0.3f, 0.2f, 1.0f}, {0.0f, 0.0f, -1.0f}};
  const auto hit = c.scene->accel->intersect(down, ~0u);
  ASSERT_TRUE(hit);
  const SurfaceInteraction at = c.scene->interaction(down, *hit, 0.0f);
  EXPECT_FALSE(at.is_back_facing);  // Blender: a mirrored object keeps its front
  EXPECT_NEAR(at.geometric_normal.z, 1.0f, 1e-6f);
}

TEST(CompileScene, LampsThatAreNotNumbersAreOff) {
  SceneBuilder b;
  b.lamp("POINT", k_nan, k_identity34).name = "poisoned";
  b.lamp("AREA", 10.0f, k_identity34).size_x = 0.0f;
  b.lamp("SUN", 1.0f, k_identity34);
  const Compiled c = compile(b.scene);
  EXPECT_TRUE(c.reports_on("poisoned", "not a number"));
  EXPECT_EQ(c.scene->lights.size(), 1u);
}

// W of a lamp to radiance, as Blender 3.4.1 renders them.
TEST(CompileScene, LampUnitsAreBlenders) {
  SceneBuilder b;
  b.lamp("AREA", 4.0f, k_identity34).size_x = 2.0f;
  LightDesc& disk = b.lamp("AREA", 4.0f, k_identity34);
  disk.shape = "DISK";
  disk.size_x = 2.0f;
  b.lamp("POINT", 1.0f, k_identity34).radius = 0.5f;
  b.lamp("POINT", 1.0f, k_identity34).radius = 0.0f;
  b.lamp("SUN", 3.0f, k_identity34);
  const Compiled c = compile(b.scene);
  EXPECT_NEAR(c.scene->lights[0].as<AreaLight>()->radiance.r, 0.25f, 1e-6f);
  EXPECT_NEAR(c.scene->lights[1].as<AreaLight>()->radiance.r, 0.31831f, 1e-5f);
  EXPECT_NEAR(c.scene->lights[2].as<PointLight>()->radiance.r, 0.101321f, 1e-6f);
  EXPECT_NEAR(c.scene->lights[3].as<PointLight>()->radiance.r, 1.0f / (4.0f * k_pi), 1e-7f);
  EXPECT_EQ(c.scene->lights[4].as<SunLight>()->irradiance.r, 3.0f);
  EXPECT_EQ(c.scene->lights[4].as<SunLight>()->axis.z, 1.0f);
}

TEST(CompileScene, EmissiveMeshesBecomeLightsUnlessTheMaterialSaysNo) {
  SceneBuilder b;
  b.object(square(), emission(2.0f));
  b.object(square(), diffuse(0.5f));
  b.object(square(), emission(2.0f));
  b.scene.materials[2].sample_as_light = false;
  const Compiled c = compile(b.scene);
  ASSERT_EQ(c.scene->lights.size(), 1u);
  EXPECT_EQ(c.scene->instances[0].light, 0);
  EXPECT_EQ(c.scene->instances[1].light, -1);
  EXPECT_EQ(c.scene->instances[2].light, -1);
  EXPECT_FLOAT_EQ(c.scene->lights[0].as<MeshLight>()->power(), 8.0f);
}

// A world whose light is not the same in all directions; it may ask which world it is in.
NodeGraph patterned_world(const char* asks_for) {
  GraphBuilder g("sky", "ShaderNodeOutputWorld");
  const uint32_t checker = g.add("ShaderNodeTexChecker");
  const uint32_t back = g.add("ShaderNodeBackground");
  g.link(checker, "Color", back, "Color").link(back, "Background", 0, "Surface");
  if (asks_for) {
    const uint32_t attribute =
        g.add("ShaderNodeAttribute", {}, {{"attribute_name", std::string(asks_for)}});
    g.link(attribute, "Fac", back, "Strength");
  }
  return g.build();
}

TEST(CompileScene, DreamsHaveLightsOfTheirOwnOnlyWhereTheyCanBeReached) {
  SceneBuilder b;
  b.scene.worlds[0].graph = patterned_world(nullptr);
  b.dream_world(2.0f).scene.worlds[1].graph = patterned_world("dream");
  b.object(square(), mirror());
  EXPECT_EQ(compile(b.scene).scene->lights.size(), 1u);
  b.scene.instances[0].looking_glass.dream = 1;
  const Compiled c = compile(b.scene);
  EXPECT_TRUE(c.scene->has_looking_glasses);
  EXPECT_EQ(c.scene->lights.size(), static_cast<size_t>(k_world_count));
}

TEST(CompileScene, ADreamWithoutAWorldOfItsOwnHasThatOfThisSide) {
  SceneBuilder b;
  b.world(1.0f).dream_world(2.0f);
  b.object(square(), mirror()).looking_glass.dream = 1;
  const Compiled c = compile(b.scene);
  EXPECT_FLOAT_EQ(c.scene->worlds[1].material.constant_emission.r, 2.0f);
  EXPECT_FLOAT_EQ(c.scene->worlds[3].material.constant_emission.r, 1.0f);
}

TEST(CompileScene, AWorldThatIsTheSameEverywhereIsNoLightToSample) {
  SceneBuilder b;
  b.object(square(), mirror()).looking_glass.dream = 1;
  b.world(0.5f);
  b.scene.worlds.push_back(b.scene.worlds[0]);
  b.scene.worlds[1].graph = patterned_world(nullptr);
  const Compiled c = compile(b.scene);
  EXPECT_EQ(c.scene->worlds[0].light, -1);
  EXPECT_TRUE(c.scene->worlds[0].material.emits);
  EXPECT_GE(c.scene->worlds[1].light, 0);
}

TEST(CompileScene, WorldsThatLookTheSameShareTheirMap) {
  const auto shares = [](const char* asks_for, bool is_same) {
    SceneBuilder b;
    b.object(square(), mirror()).looking_glass.dream = 1;
    b.scene.worlds[0].graph = patterned_world(asks_for);
    b.scene.worlds.push_back(b.scene.worlds[0]);
    if (!is_same) b.scene.worlds[1].graph.nodes[1].inputs["Scale"] = {7.0f};
    const Compiled c = compile(b.scene);
    const auto light = [&](WorldIndex w) {
      return c.scene->lights[static_cast<size_t>(c.scene->worlds[w].light)].as<EnvironmentLight>();
    };
    return light(1)->shares_map_with(*light(0));
  };
  EXPECT_TRUE(shares(nullptr, true));
  EXPECT_FALSE(shares(nullptr, false));
  EXPECT_FALSE(shares("dream", true));
}

TEST(CompileScene, CameraMayBeWrongInItsClipNotInItsPlace) {
  SceneBuilder b;
  b.scene.camera.clip_start = 10.0f;
  b.scene.camera.clip_end = 1.0f;
  EXPECT_TRUE(compile(b.scene).reports_on("Camera", "clip"));
  b.scene.camera.camera_to_world[0] = k_nan;
  EXPECT_THROW(compile(b.scene), SceneError);
}

TEST(CompileScene, CancelGivesNoScene) {
  SceneBuilder b;
  b.object(sphere(), diffuse(0.5f));
  const std::atomic<bool> cancelled{true};
  Diagnostics diagnostics;
  EXPECT_FALSE(compile_scene(b.scene, diagnostics, {&cancelled, {}}));
}

TEST(CompileScene, CancelIsHeardInEveryStage) {
  SceneBuilder b;
  b.object(sphere(), diffuse(0.5f));
  std::vector<std::string> stages;
  Diagnostics diagnostics;
  const auto note = [&](const char* stage) { stages.emplace_back(stage); };
  EXPECT_TRUE(compile_scene(b.scene, diagnostics, {nullptr, note}));
  ASSERT_GT(stages.size(), 3u);
  for (const std::string& last : stages) {
    std::atomic<bool> cancelled{false};
    const auto cancel = [&](const char* stage) { cancelled = last == stage; };
    EXPECT_FALSE(compile_scene(b.scene, diagnostics, {&cancelled, cancel})) << last;
  }
}

}  // namespace
}  // namespace tenniel
