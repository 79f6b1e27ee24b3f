// SPDX-License-Identifier: Apache-2.0
// Media and the looking glass: a medium belongs to the worlds of its boundary.
#include <gtest/gtest.h>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr float k_root2 = 1.41421356f;

// A looking glass in the xy plane, seen at 45 degrees from y = -2; its reflection goes to a glowing
// square 3 sqrt(2) away.
SceneBuilder glass_and_glow() {
  SceneBuilder b;
  b.object(square(), mirror()).looking_glass.dream = 1;
  b.object(square(), emission(1.0f), turned(-45.0f, 0.0f, 3.0f, 3.0f));
  b.ortho_camera(turned(45.0f, 0.0f, -2.0f, 2.0f), 1e-3f);
  b.scene.settings.samples = 4;
  b.scene.settings.min_light_bounces = 64;  // no roulette: every sample is exact
  return b;
}
// A wall of fog, `y0` to `y1`.
void add_fog(SceneBuilder& b, float y0, float y1, uint32_t worlds) {
  const float half = 0.5f * (y1 - y0);
  b.object(box(), absorption(0.5f), {50, 0, 0, 0, 0, half, 0, y0 + half, 0, 0, 50, 0})
      .visibility.worlds = worlds;
}

TEST(MediaMirror, FogBehindIsSeenInTheGlassAlone) {
  SceneBuilder b = glass_and_glow();
  add_fog(b, 1.0f, 2.0f, k_behind);
  EXPECT_NEAR(mean_of(render(b.scene)).value, std::exp(-0.5f * k_root2), 1e-5);
  // The same way without the glass: straight at the square.
  b.ortho_camera(turned(135.0f, 0.0f, 0.0f, 0.0f), 1e-3f);
  b.scene.instances[0].visibility.worlds = 0;
  EXPECT_NEAR(mean_of(render(b.scene)).value, 1.0, 1e-5);
}

TEST(MediaMirror, FogOfThisSideIsNotInTheGlass) {
  SceneBuilder b = glass_and_glow();
  add_fog(b, 1.0f, 2.0f, k_this_side);
  EXPECT_NEAR(mean_of(render(b.scene)).value, 1.0, 1e-5);
  b = glass_and_glow();
  add_fog(b, -1.5f, -0.5f, k_this_side);  // before the glass
  EXPECT_NEAR(mean_of(render(b.scene)).value, std::exp(-0.5f * k_root2), 1e-5);
}

// Fog that holds the glass: on entering, the path leaves that of this side and finds that of the
// dream, whose boundary it never crossed.
TEST(MediaMirror, FogAroundTheGlassBelongsToItsWorld) {
  const double before = 0.5 * 2.0 * k_root2, after = 0.5 * 3.0 * k_root2;
  const std::pair<uint32_t, double> cases[] = {
      {k_this_side, before}, {k_behind, after}, {k_everywhere, before + after}};
  for (const auto& [worlds, depth] : cases) {
    SceneBuilder b = glass_and_glow();
    add_fog(b, -10.0f, 10.0f, worlds);
    EXPECT_NEAR(mean_of(render(b.scene)).value, std::exp(-depth), 2e-4);
  }
}

TEST(MediaMirror, ABehindLookMayFillAnObject) {
  SceneBuilder b = glass_and_glow();
  add_fog(b, 1.0f, 2.0f, k_everywhere);
  b.scene.instances.back().behind_materials = {b.material(absorption(1.5f))};
  EXPECT_NEAR(mean_of(render(b.scene)).value, std::exp(-1.5f * k_root2), 1e-5);
}

TEST(MediaMirror, EachWorldHasItsOwnAir) {
  SceneBuilder b = glass_and_glow();
  b.scene.worlds.resize(2);
  GraphBuilder g("fog", "ShaderNodeOutputWorld");
  g.volume(g.add("ShaderNodeVolumeAbsorption", {{"Color", grey(0.0f)}, {"Density", {0.3f}}}));
  b.scene.worlds[1].graph = g.build();
  EXPECT_NEAR(mean_of(render(b.scene)).value, std::exp(-0.3f * 3.0f * k_root2), 2e-4);
}

// A rough glass in fog that scatters: sampled light and light met by chance agree.
class FoggyGlassStatistics : public ::testing::TestWithParam<uint32_t> {};

TEST_P(FoggyGlassStatistics, LightSamplingAndChanceAgree) {
  const auto picture = [&](bool sampled) {
    SceneBuilder b;
    b.object(square(), glossy(0.4f)).looking_glass.dream = 1;
    b.object(box(), scatter(0.4f, 0.3f, 0.9f), at(0.0f, 0.0f, 0.0f, 4.0f)).visibility.worlds =
        GetParam();
    light_both_sides(b, sampled);
    b.scene.settings.samples = 4096;
    b.scene.settings.max_bounces = b.scene.settings.volume_bounces = 2;
    return mean_of(render(std::move(b.scene)));
  };
  const Mean sampled = picture(true), chance = picture(false);
  EXPECT_LT(chance.error, 0.02 * chance.value);
  EXPECT_NEAR(sampled.value, chance.value,
              4.0 * std::hypot(sampled.error, chance.error) + 1e-3 * chance.value);
}

INSTANTIATE_TEST_SUITE_P(Mirror, FoggyGlassStatistics,
                         ::testing::Values(k_everywhere, k_behind, k_this_side));

}  // namespace
}  // namespace tenniel
