// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <string>

#include "scene/compile_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

NodeGraph world_of(const std::string& texture, std::map<std::string, SettingValue> settings) {
  GraphBuilder g("sky", "ShaderNodeOutputWorld");
  const uint32_t color = g.add(texture, {}, std::move(settings));
  const uint32_t back = g.add("ShaderNodeBackground");
  g.link(color, "Color", back, "Color").link(back, "Background", 0, "Surface");
  return g.build();
}

std::shared_ptr<const Scene> compile_world(const SceneDescription& description) {
  Diagnostics diagnostics;
  return compile_scene(description, diagnostics, {});
}

const EnvironmentLight& environment_of(const Scene& scene) {
  return *scene.lights[static_cast<size_t>(scene.worlds[0].light)].as<EnvironmentLight>();
}

TEST(CompileEnvironment, TheMapDoesNotKnowHowManyThreadsMadeIt) {
  SceneBuilder b;
  b.scene.worlds[0].graph = world_of("ShaderNodeTexVoronoi", {});
  const auto many = compile_world(b.scene);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto one = compile_world(b.scene);
  EXPECT_EQ(environment_of(*many).mean_radiance(), environment_of(*one).mean_radiance());
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = equirectangular_to_direction(
        {static_cast<float>(i % 211) / 211.0f, static_cast<float>(i) / 20000.0f});
    ASSERT_EQ(environment_of(*many).pdf(direction), environment_of(*one).pdf(direction));
  }
}

// The bright pixel lies between all points of a map of 1024 columns.
TEST(CompileEnvironment, TheMapIsAsFineAsThePicture) {
  constexpr int k_width = 4096, k_height = 4;
  constexpr size_t k_pixel = k_width + 1000;
  SceneBuilder b;
  ImageTileDesc tile;
  tile.width = k_width;
  tile.height = k_height;
  tile.pixels = std::make_shared<std::vector<float>>(4 * k_width * k_height, 0.1f);
  for (size_t c = 0; c < 3; ++c)
    (*tile.pixels)[4 * k_pixel + c] = 5000.0f;
  ImageDesc image;
  image.colorspace = "Linear";
  image.is_float = true;
  image.alpha_mode = "NONE";
  image.tiles = {tile};
  b.scene.images = {image};
  b.scene.worlds[0].graph = world_of("ShaderNodeTexEnvironment", {{"image", 0}});
  const auto scene = compile_world(b.scene);
  const Vec3 spot = equirectangular_to_direction({1000.5f / k_width, 1.5f / k_height});
  const Vec3 beside = equirectangular_to_direction({1002.0f / k_width, 1.5f / k_height});
  EXPECT_GT(environment_of(*scene).pdf(spot), 1e4f * environment_of(*scene).pdf(beside));
}

TEST(CompileEnvironment, CancelIsHeardWhileAMapIsMade) {
  SceneBuilder b;
  b.scene.worlds[0].graph = world_of("ShaderNodeTexVoronoi", {});
  Diagnostics diagnostics;
  std::atomic<bool> cancelled{false};
  const auto cancel = [&](const char* stage) { cancelled = std::string(stage) == "Lights"; };
  EXPECT_FALSE(compile_scene(b.scene, diagnostics, {&cancelled, cancel}));
}

}  // namespace
}  // namespace tenniel
