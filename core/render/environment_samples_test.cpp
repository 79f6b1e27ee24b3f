// SPDX-License-Identifier: Apache-2.0
#include "integrator/environment_samples.h"

#include <gtest/gtest.h>

#include "scene/compile_scene.h"
#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// As bright as the direction is high; black below the horizon. `reader` names a node and its output
// that shine as well.
NodeGraph bright_zenith(const char* reader = nullptr, const char* output = nullptr) {
  GraphBuilder g("world", "ShaderNodeOutputWorld");
  const uint32_t coordinate = g.add("ShaderNodeTexCoord");
  const uint32_t parts = g.add("ShaderNodeSeparateXYZ");
  const uint32_t positive = g.add("ShaderNodeMath", {{"Value_001", {0.0f}}, {"Value_002", {0.0f}}},
                                  {{"operation", std::string("MAXIMUM")}});
  const uint32_t shader = g.add("ShaderNodeBackground", {{"Color", grey(1.0f)}});
  g.link(coordinate, "Generated", parts, "Vector").link(parts, "Z", positive, "Value");
  g.link(positive, "Value", shader, "Strength");
  if (reader) g.link(g.add(reader), output, shader, "Color");
  return g.surface(shader, "Background").build();
}

// A floor under it, seen from above.
SceneDescription floor_under(NodeGraph world) {
  SceneBuilder b;
  b.object(square(), diffuse(0.75f));
  b.world(0.0f).ortho_camera(at(0.0f, 0.0f, 5.0f), 1.0f);
  b.scene.worlds[0].graph = std::move(world);
  return std::move(b.scene);
}

std::shared_ptr<const Scene> compiled(SceneDescription description) {
  Diagnostics diagnostics;
  return compile_scene(std::move(description), diagnostics, {});
}

Vec2 middle_of(size_t x, size_t y) {
  constexpr auto side = static_cast<float>(EnvironmentSamples::k_side);
  return {(static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side};
}

TEST(EnvironmentSamples, AreThoseOfTheLight) {
  const auto scene = compiled(floor_under(bright_zenith()));
  const auto* light =
      scene->lights[static_cast<size_t>(scene->worlds[0].light)].as<EnvironmentLight>();
  const EnvironmentSamples samples(*scene, 1, 0);
  double energy = 0.0;
  for (size_t y = 0; y < EnvironmentSamples::k_side; ++y) {
    for (size_t x = 0; x < EnvironmentSamples::k_side; ++x) {
      const EnvironmentSample& s = *samples.find(0, middle_of(x, y));
      if (!(s.pdf > 0.0f)) continue;
      EXPECT_NEAR(s.pdf, light->pdf(s.wi), 1e-2f * s.pdf);
      EXPECT_NEAR(s.radiance.g, std::max(s.wi.z, 0.0f), 1e-4f);
      energy += static_cast<double>(s.radiance.g / s.pdf);
    }
  }
  // The integral of z over the upper half of all directions.
  EXPECT_NEAR(energy / static_cast<double>(EnvironmentSamples::k_count), 3.14159265, 2e-3);
}

// The numbers of a pixel must reach every direction, and as evenly as in the unit square.
TEST(EnvironmentSamples, EachCellHasItsOwn) {
  const auto scene = compiled(floor_under(bright_zenith()));
  const auto* light =
      scene->lights[static_cast<size_t>(scene->worlds[0].light)].as<EnvironmentLight>();
  const EnvironmentSamples samples(*scene, 1, 0);
  for (const auto& [x, y] : {std::pair{0, 0}, {255, 255}, {17, 200}, {128, 3}}) {
    const auto cx = static_cast<size_t>(x), cy = static_cast<size_t>(y);
    const EnvironmentSample& s = *samples.find(0, middle_of(cx, cy));
    const auto in_middle = light->sample(middle_of(cx, cy));
    EXPECT_GT(dot(s.wi, in_middle->wi), 0.99f) << x << " " << y;
  }
  const Vec2 last{k_one_minus_epsilon, k_one_minus_epsilon};
  EXPECT_EQ(samples.find(0, last), samples.find(0, middle_of(255, 255)));
}

// Behind every mirror without a World of its own.
TEST(EnvironmentSamples, WorldsThatLookTheSameShareThem) {
  SceneDescription description = floor_under(bright_zenith());
  description.settings.start_world = 1;
  const auto scene = compiled(std::move(description));
  ASSERT_GE(scene->worlds[1].light, 0);
  const EnvironmentSamples samples(*scene, 1, 0);
  ASSERT_NE(samples.find(0, middle_of(7, 9)), nullptr);
  EXPECT_EQ(samples.find(0, middle_of(7, 9)), samples.find(1, middle_of(7, 9)));
}

TEST(EnvironmentSamples, EachPassHasOthers) {
  const auto scene = compiled(floor_under(bright_zenith()));
  const EnvironmentSamples first(*scene, 1, 0), again(*scene, 1, 0), next(*scene, 1, 8),
      other(*scene, 2, 0);
  const Vec2 u = middle_of(100, 100);
  EXPECT_EQ(first.find(0, u)->wi, again.find(0, u)->wi);
  EXPECT_NE(first.find(0, u)->wi, next.find(0, u)->wi);
  EXPECT_NE(first.find(0, u)->wi, other.find(0, u)->wi);
}

TEST(EnvironmentSamples, AWorldThatAsksForThePathHasNone) {
  const Vec2 u{0.5f, 0.5f};
  const auto asking = compiled(floor_under(bright_zenith("ShaderNodeLightPath", "Ray Depth")));
  ASSERT_GE(asking->worlds[0].light, 0);
  EXPECT_EQ(EnvironmentSamples(*asking, 1, 0).find(0, u), nullptr);
  // Nor one that is the same everywhere: it is met by chance.
  const auto even = compiled(floor_under(background(1.0f)));
  EXPECT_EQ(EnvironmentSamples(*even, 1, 0).find(0, u), nullptr);
  EXPECT_EQ(EnvironmentSamples(*even, 1, 0).find(1, u), nullptr);
}

// A floor sees two thirds of what it would under a World as bright as the zenith. Its second half
// of samples is made in advance.
TEST(EnvironmentSamplesStatistics, AFloorIsAsBrightAsTheClosedForm) {
  const auto picture = [](int threads) {
    SceneDescription scene = floor_under(bright_zenith());
    scene.settings.width = scene.settings.height = 256;
    scene.settings.samples = 16;
    scene.settings.threads = threads;
    return render(std::move(scene));
  };
  const Picture one = picture(1);
  EXPECT_NEAR(mean_of(one).value, 0.75 * 2.0 / 3.0, 5e-4);
  EXPECT_EQ(one.rgba, picture(2).rgba);
}

}  // namespace
}  // namespace tenniel
