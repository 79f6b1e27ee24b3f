// SPDX-License-Identifier: Apache-2.0
// Light that reaches a floor through what lets some of it pass.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

NodeGraph clear(float share) {
  return single("ShaderNodeBsdfTransparent", {{"Color", grey(share)}});
}

// A white floor under layers that pass `shares` each, the first the highest; seen from below them.
SceneBuilder floor_under(const std::vector<float>& shares) {
  SceneBuilder b;
  b.object(square(), diffuse(1.0f), at(0.0f, 0.0f, 0.0f, 20.0f));
  float height = 1.0f + static_cast<float>(shares.size());
  for (const float share : shares)
    b.object(square(), share > 0.0f ? clear(share) : diffuse(0.5f),
             at(0.0f, 0.0f, height--, 20.0f));
  b.lamp("SUN", 3.14159265f, k_identity34).angle = 0.0f;
  b.ortho_camera(at(0.0f, 0.0f, 0.5f), 0.01f);
  b.scene.settings.max_bounces = 0;
  b.scene.settings.samples = 4;
  return b;
}

TEST(TransparentShadows, DimByTheProductOfTheLayers) {
  EXPECT_NEAR(mean_of(render(floor_under({}).scene)).value, 1.0, 1e-5);
  EXPECT_NEAR(mean_of(render(floor_under({0.5f}).scene)).value, 0.5, 1e-5);
  EXPECT_NEAR(mean_of(render(floor_under({0.5f, 0.8f, 0.9f}).scene)).value, 0.36, 1e-5);
}

TEST(TransparentShadows, AreBlackWhereAnythingBlocks) {
  for (const auto& shares : {std::vector{0.0f, 0.8f}, {0.8f, 0.0f}, {0.5f, 0.0f, 0.9f}})
    EXPECT_EQ(mean_of(render(floor_under(shares).scene)).value, 0.0);
}

TEST(TransparentShadows, EndAtTheLimitOfLayers) {
  SceneBuilder b = floor_under({0.5f, 0.8f, 0.9f});
  b.scene.settings.transparent_max_bounces = 3;
  EXPECT_NEAR(mean_of(render(b.scene)).value, 0.36, 1e-5);
  b.scene.settings.transparent_max_bounces = 2;
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

// Each layer is told how many the light has passed before, in whatever order they are found.
TEST(TransparentShadows, LayersAreCountedFromTheFloor) {
  GraphBuilder g("by depth");
  const uint32_t path = g.add("ShaderNodeLightPath");
  const uint32_t share = g.add("ShaderNodeMath", {{"Value_001", {0.2f}}, {"Value_002", {0.3f}}},
                               {{"operation", std::string("MULTIPLY_ADD")}});
  const uint32_t closure = g.add("ShaderNodeBsdfTransparent");
  g.link(path, "Transparent Depth", share, "Value").link(share, "Value", closure, "Color");
  const NodeGraph by_depth = g.surface(closure).build();
  for (size_t below = 0; below < 3; ++below) {
    SceneBuilder b = floor_under({1.0f, 1.0f, 1.0f});
    b.scene.materials[3 - below].graph = by_depth;  // after the floor, from the highest down
    EXPECT_NEAR(mean_of(render(b.scene)).value, 0.3 + 0.2 * static_cast<double>(below), 1e-5);
  }
}

}  // namespace
}  // namespace tenniel
