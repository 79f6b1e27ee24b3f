// SPDX-License-Identifier: Apache-2.0
// The looking glass in whole pictures: each test is one of the proofs that its definition asks for.
#include <gtest/gtest.h>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

NodeGraph coated_mirror(float roughness) {
  GraphBuilder g("coated");
  const uint32_t d = g.add("ShaderNodeBsdfDiffuse", {{"Color", grey(0.6f)}});
  const uint32_t s =
      g.add("ShaderNodeBsdfGlossy", {{"Color", grey(0.9f)}, {"Roughness", {roughness}}},
            {{"distribution", std::string("GGX")}});
  const uint32_t mix = g.add("ShaderNodeMixShader", {{"Fac", {0.4f}}});
  g.link(d, "BSDF", mix, "Shader").link(s, "BSDF", mix, "Shader_001");
  return g.surface(mix, "Shader").build();
}

NodeGraph half_transparent(float roughness) {
  GraphBuilder g("alpha");
  const uint32_t t = g.add("ShaderNodeBsdfTransparent", {{"Color", grey(1.0f)}});
  const uint32_t s =
      g.add("ShaderNodeBsdfGlossy", {{"Color", grey(1.0f)}, {"Roughness", {roughness}}},
            {{"distribution", std::string("GGX")}});
  const uint32_t mix = g.add("ShaderNodeMixShader", {{"Fac", {0.5f}}});
  g.link(t, "BSDF", mix, "Shader").link(s, "BSDF", mix, "Shader_001");
  return g.surface(mix, "Shader").build();
}

// A looking glass in the xy plane seen from above at 45 degrees, and a bright square where its
// reflection goes.
SceneBuilder glass_and_square(NodeGraph surface, float radiance) {
  SceneBuilder b;
  b.object(square(), std::move(surface)).looking_glass.dream = 1;
  b.object(square(), emission(radiance), turned(-45.0f, 0.0f, 3.0f, 3.0f));
  b.scene.instances[1].visibility.worlds = k_behind;
  b.ortho_camera(turned(45.0f, 0.0f, -2.0f, 2.0f), 0.4f);
  return b;
}

TEST(Mirror, ShowsWhatIsOnlyBehindIt) {
  SceneBuilder b = glass_and_square(mirror(), 3.0f);
  EXPECT_NEAR(mean_of(render(b.scene)).value, 3.0, 1e-4);
  // Seen directly, or in an ordinary mirror, it is not there.
  b.scene.instances[0].looking_glass.dream = 0;
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

TEST(Mirror, HidesWhatIsOnlyOnThisSide) {
  SceneBuilder b = glass_and_square(mirror(), 3.0f);
  b.scene.instances[1].visibility.worlds = k_this_side;
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

TEST(Mirror, EachDreamHasItsOwnWorldAndObjects) {
  SceneBuilder b = glass_and_square(mirror(), 3.0f);
  b.dream_world(5.0f).dream_world(7.0f);
  b.scene.instances[1].visibility.worlds = 1u << 2;  // only in dream 2
  EXPECT_NEAR(mean_of(render(b.scene)).value, 5.0, 1e-4);
  b.scene.instances[0].looking_glass.dream = 2;
  EXPECT_NEAR(mean_of(render(b.scene)).value, 3.0, 1e-4);
  b.scene.instances.pop_back();
  EXPECT_NEAR(mean_of(render(b.scene)).value, 7.0, 1e-4);
}

TEST(Mirror, BehindLookReplacesTheMaterialInDreams) {
  SceneBuilder b = glass_and_square(mirror(), 3.0f);
  b.scene.instances[1].visibility.worlds = 0x1f;
  b.scene.instances[1].behind_materials = {b.material(emission(8.0f))};
  EXPECT_NEAR(mean_of(render(b.scene)).value, 8.0, 1e-4);
  b.scene.instances[0].looking_glass.dream = 0;
  EXPECT_NEAR(mean_of(render(b.scene)).value, 3.0, 1e-4);
}

// Passes: which dream is seen first, by how much of the pixel, and what comes through the glass.
TEST(Mirror, PassesTellWhatIsSeenInTheGlass) {
  const auto mean_of_pass = [](const SceneDescription& scene, const char* name) {
    const std::vector<float> values = render_pass(scene, name);
    double sum = 0.0;
    for (const float v : values)
      sum += v;
    return sum / static_cast<double>(values.size());
  };
  SceneBuilder b = glass_and_square(coated_mirror(0.0f), 3.0f);
  b.scene.instances[0].looking_glass.dream = 2;
  b.scene.settings.samples = 1024;
  EXPECT_EQ(mean_of_pass(b.scene, "Mirror World"), 2.0);
  // The mirror's share of the choice between the lobes, by their albedo.
  EXPECT_NEAR(mean_of_pass(b.scene, "Mirror Coverage"), 0.36 / (0.36 + 0.36), 0.01);
  const double through = mean_of_pass(b.scene, "Dream");
  EXPECT_NEAR(through, 0.4 * 0.9 * 3.0, 0.02);
  // Light on the matte part comes from this side.
  b.world(1.0f);
  b.dream_world(0.0f);
  b.scene.worlds.push_back(b.scene.worlds[1]);
  EXPECT_NEAR(mean_of_pass(b.scene, "Dream"), through, 0.02);
  EXPECT_NEAR(mean_of(render(b.scene)).value, through + 0.6 * 0.6, 0.02);
  b.scene.instances[0].looking_glass.dream = 0;
  for (const char* name : {"Mirror World", "Mirror Coverage", "Dream"})
    EXPECT_EQ(mean_of_pass(b.scene, name), 0.0) << name;
}

// Light that falls through the glass onto a floor: what a dream shows does light this side, but
// only by reflection in the glass.
TEST(Mirror, BehindLightReachesNothingWithoutTheGlass) {
  SceneBuilder b;
  b.object(square(), diffuse(1.0f));
  b.object(square(), emission(10.0f), at(0.0f, 0.0f, 1.0f, 0.3f));
  b.scene.instances[1].visibility.worlds = k_behind;
  LightDesc& lamp = b.lamp("POINT", 100.0f, at(0.5f, 0.0f, 1.0f));
  lamp.visibility.worlds = k_behind;
  b.ortho_camera(turned(40.0f, 0.0f, -0.8f, 1.0f), 0.3f);
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

// A floor seen in the mirror lies in the shadow of what is only behind; seen directly in the shadow
// of what is only here.
TEST(Mirror, ShadowsBelongToTheirWorld) {
  SceneBuilder b;
  b.object(square(), mirror(), turned(90.0f, 0.0f, 2.0f, 0.5f)).looking_glass.dream = 1;
  b.object(square(), diffuse(0.8f));
  b.object(square(), diffuse(0.0f), at(0.0f, 0.0f, 2.0f, 1.5f));  // the blocker
  b.lamp("POINT", 100.0f, at(0.0f, 0.0f, 4.0f));
  b.scene.settings.max_bounces = 1;
  const auto direct = [&](uint32_t worlds) {
    b.scene.instances[2].visibility.worlds = worlds;
    b.ortho_camera(turned(60.0f, 0.0f, -1.5f, 0.8660254f), 0.1f);
    return mean_of(render(b.scene)).value;
  };
  const auto reflected = [&](uint32_t worlds) {
    b.scene.instances[2].visibility.worlds = worlds;
    // Toward the mirror at y = 2 and down to the floor behind it.
    b.ortho_camera(turned(70.0f, 0.0f, 0.2f, 1.0f), 0.1f);
    return mean_of(render(b.scene)).value;
  };
  EXPECT_GT(direct(k_behind), 0.01);
  EXPECT_EQ(direct(k_this_side), 0.0);
  EXPECT_EQ(reflected(k_behind), 0.0);
  EXPECT_GT(reflected(k_this_side), 0.01);
}

TEST(Mirror, FurnaceIsOneInEveryWorld) {
  SceneBuilder b;
  b.world(1.0f);
  b.object(square(), mirror()).looking_glass.dream = 1;
  b.object(sphere(), diffuse(1.0f), at(0.0f, 1.0f, 1.5f, 0.5f)).visibility.worlds = k_behind;
  b.object(sphere(), diffuse(1.0f), at(0.5f, 0.0f, 0.7f, 0.4f)).visibility.worlds = k_this_side;
  b.ortho_camera(turned(45.0f, 0.0f, -2.0f, 2.0f), 1.5f);
  b.scene.settings.samples = 256;
  const Mean found = mean_of(render(std::move(b.scene)));
  EXPECT_LT(found.error, 5e-3);
  EXPECT_NEAR(found.value, 1.0, 4.0 * found.error + 1e-3);
}

struct MixedCase {
  const char* name;
  NodeGraph graph;
};
class MixedGlassStatistics : public ::testing::TestWithParam<MixedCase> {};

// On a glass whose lobes lead to different worlds, sampled light and light met by chance agree:
// they do not when the densities of the groups are mixed.
TEST_P(MixedGlassStatistics, LightSamplingAndChanceAgree) {
  const auto picture = [&](bool sampled) {
    SceneBuilder b;
    b.object(square(), GetParam().graph).looking_glass.dream = 1;
    light_both_sides(b, sampled);
    b.scene.settings.samples = 2048;
    b.scene.settings.max_bounces = 1;
    return mean_of(render(std::move(b.scene)));
  };
  const Mean sampled = picture(true), chance = picture(false);
  EXPECT_GT(sampled.value, 0.05);
  EXPECT_LT(chance.error, 0.02 * chance.value);
  EXPECT_NEAR(sampled.value, chance.value,
              4.0 * std::hypot(sampled.error, chance.error) + 1e-3 * chance.value);
}

INSTANTIATE_TEST_SUITE_P(Mirror, MixedGlassStatistics,
                         ::testing::Values(MixedCase{"rough", glossy(0.4f)},
                                           MixedCase{"coated", coated_mirror(0.4f)},
                                           MixedCase{"alpha", half_transparent(0.4f)}),
                         [](const auto& test) { return test.param.name; });

// Two facing mirrors: a ray goes up and down between them. A glowing pane that only the dream has
// lies between; under Stay every pass after the first reflection meets it, under Toggle every
// other.
TEST(Mirror, StayAndToggleAreCountedByDepth) {
  const auto radiance = [](const char* reentry, int bounces) {
    SceneBuilder b;
    for (const float z : {0.0f, 2.0f}) {
      InstanceDesc& glass = b.object(square(), mirror(), at(0.0f, 0.0f, z, 5.0f));
      glass.looking_glass.dream = 1;
      glass.looking_glass.reentry = reentry;
    }
    GraphBuilder g("pane");
    const uint32_t t = g.add("ShaderNodeBsdfTransparent", {{"Color", grey(1.0f)}});
    const uint32_t e = g.add("ShaderNodeEmission", {{"Color", grey(1.0f)}, {"Strength", {1.0f}}});
    const uint32_t sum = g.add("ShaderNodeAddShader");
    g.link(t, "BSDF", sum, "Shader").link(e, "Emission", sum, "Shader_001");
    g.surface(sum, "Shader");
    b.object(square(), g.build(), at(0.0f, 0.0f, 1.0f, 5.0f)).visibility.worlds = k_behind;
    b.ortho_camera(at(0.0f, 0.0f, 1.5f), 0.5f);
    b.scene.settings.samples = 2;
    b.scene.settings.max_bounces = bounces;
    b.scene.settings.min_light_bounces = 64;
    return mean_of(render(std::move(b.scene))).value;
  };
  // `bounces` + 1 reflections happen: the last one may still meet what glows.
  for (const int bounces : {0, 1, 2, 3, 6}) {
    const int passes = bounces + 1;
    EXPECT_NEAR(radiance("STAY", bounces), passes, 1e-4);
    const int seen_here = (passes + 1) / 2;
    EXPECT_NEAR(radiance("TOGGLE", bounces), seen_here, 1e-4);
  }
}

TEST(Mirror, PortalEntersByTransparency) {
  SceneBuilder b;
  InstanceDesc& portal =
      b.object(square(), single("ShaderNodeBsdfTransparent", {{"Color", grey(1.0f)}}));
  portal.looking_glass.dream = 1;
  portal.looking_glass.entry = "TRANSMISSION";
  b.object(square(), emission(4.0f), at(0.0f, 0.0f, -1.0f, 3.0f)).visibility.worlds = k_behind;
  b.ortho_camera(at(0.0f, 0.0f, 1.0f), 0.5f);
  EXPECT_NEAR(mean_of(render(b.scene)).value, 4.0, 1e-4);
  b.scene.instances[0].looking_glass.entry = "REFLECTION";
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

// Tags that change nothing visible change no bit: the worlds draw no random numbers.
TEST(Mirror, UntaggedSceneIsTheSameBitForBit) {
  const auto picture = [](int dream) {
    SceneBuilder b;
    b.world(0.7f);
    b.object(square(), coated_mirror(0.3f)).looking_glass.dream = 0;
    b.object(sphere(), diffuse(0.7f), at(0.0f, 0.0f, 0.5f, 0.4f));
    // A looking glass that nobody sees.
    b.object(square(), mirror(), at(100.0f, 0.0f, 0.0f)).looking_glass.dream = dream;
    b.lamp("POINT", 30.0f, at(1.0f, -1.0f, 2.0f)).radius = 0.3f;
    b.ortho_camera(turned(45.0f, 0.0f, -2.0f, 2.0f), 1.5f);
    return render(std::move(b.scene)).rgba;
  };
  EXPECT_EQ(picture(0), picture(1));
}

}  // namespace
}  // namespace tenniel
