// SPDX-License-Identifier: Apache-2.0
// Participating media in whole pictures whose radiance is known in closed form.
#include <gtest/gtest.h>

#include <functional>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

void expect_mean(const Mean& found, double wanted, double least_precision) {
  EXPECT_LT(found.error, least_precision * wanted);
  EXPECT_NEAR(found.value, wanted, 4.0 * found.error + 2e-5 * wanted);
}

// A box 2 * `half` high that reaches far to the sides.
Matrix34 slab(float half, float z = 0.0f) {
  return {100, 0, 0, 0, 0, 100, 0, 0, 0, 0, half, z};
}

// A camera far above that looks straight down at a small spot.
SceneBuilder seen_from_above(float radiance) {
  SceneBuilder b;
  b.world(radiance).ortho_camera(at(0.0f, 0.0f, 50.0f), 0.1f);
  b.scene.settings.samples = 16;
  return b;
}

TEST(Media, SlabTransmittance) {
  SceneBuilder b = seen_from_above(1.0f);
  b.object(box(),
           volume("ShaderNodeVolumeAbsorption",
                  {{"Color", {0.2f, 0.5f, 0.9f, 1.0f}}, {"Density", {0.7f}}}),
           slab(1.0f));
  const Spectrum seen = render(b.scene).pixel(3, 4);
  EXPECT_NEAR(seen.r, 0.32628, 1e-5);
  EXPECT_NEAR(seen.g, 0.49659, 1e-5);
  EXPECT_NEAR(seen.b, 0.86936, 1e-5);
}

TEST(Media, OverlappingAndNestedMediaAddUp) {
  SceneBuilder b = seen_from_above(1.0f);
  b.object(box(), absorption(0.3f), slab(1.0f));
  b.object(box(), absorption(0.5f), slab(0.5f, 0.75f));  // reaches out of the first by 0.25
  b.object(box(), absorption(0.7f), slab(0.25f));        // inside the first
  const double depth = 0.3 * 2.0 + 0.5 * 1.0 + 0.7 * 0.5;
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, std::exp(-depth), 1e-5);
}

TEST(Media, CameraMayStandInside) {
  for (const bool instanced : {false, true}) {
    SceneBuilder b = seen_from_above(1.0f);
    b.object(box(), absorption(0.5f), slab(3.0f));
    if (instanced) b.instance(0, 0, at(0.0f, 0.0f, -50.0f));
    b.object(sphere(), absorption(0.25f), at(0.0f, 0.0f, 0.0f, 2.0f));
    b.ortho_camera(at(0.0f, 0.0f, 1.0f), 0.01f);
    const double depth = 0.5 * (1.0 + 3.0) + 0.25 * (1.0 + 2.0) + (instanced ? 0.5 * 2.0 : 0.0);
    EXPECT_NEAR(render(b.scene).pixel(3, 4).g, std::exp(-depth), 2e-4);
  }
}

TEST(Media, WorldVolumeDimsByDistance) {
  SceneBuilder b;
  GraphBuilder g("fog", "ShaderNodeOutputWorld");
  const uint32_t v =
      g.add("ShaderNodeVolumeAbsorption", {{"Color", grey(0.0f)}, {"Density", {0.2f}}});
  const uint32_t light = g.add("ShaderNodeBackground", {{"Color", grey(1.0f)}});
  b.scene.worlds[0].graph = g.volume(v).surface(light, "Background").build();
  b.object(square(), emission(1.0f));
  b.ortho_camera(at(0.0f, 0.0f, 4.0f), 0.1f);
  b.scene.settings.samples = 4;
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, std::exp(-0.2 * (4.0 - 1e-4)), 1e-5);
  // Nothing comes from infinitely far.
  b.scene.instances.clear();
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

TEST(Media, GlowingSlabIsTheIntegralOfItsEmission) {
  SceneBuilder b = seen_from_above(0.0f);
  b.object(box(),
           volume("ShaderNodeVolumePrincipled",
                  {{"Color", grey(0.0f)}, {"Density", {0.5f}}, {"Emission Strength", {0.3f}}}),
           slab(1.0f));
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, 0.3 * (1.0 - std::exp(-1.0)) / 0.5, 1e-5);
  b.scene.materials[0].graph =
      volume("ShaderNodeEmission", {{"Color", grey(1.0f)}, {"Strength", {0.3f}}}, "Emission");
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, 0.6, 1e-5);
}

TEST(Media, ShadowsAreDimmedByAllMediaOnTheWay) {
  SceneBuilder b;
  b.object(square(), diffuse(1.0f));
  b.object(box(), absorption(0.5f), slab(0.5f, 2.0f));
  b.object(box(), absorption(1.5f), slab(0.1f, 2.0f));
  LightDesc& sun = b.lamp("SUN", 3.14159265f, k_identity34);
  sun.angle = 0.0f;
  b.ortho_camera(turned(40.0f, 0.0f, -0.8f, 1.0f), 0.1f);
  b.scene.settings.samples = 4;
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, std::exp(-0.5 * 1.0 - 1.5 * 0.2), 1e-5);
}

TEST(Media, BoundariesCountAsNoSurface) {
  SceneBuilder b = seen_from_above(0.0f);
  for (int i = 0; i < 20; ++i)
    b.object(box(), absorption(0.1f), slab(0.1f, static_cast<float>(i) - 10.0f));
  b.object(square(), emission(1.0f), at(0.0f, 0.0f, -20.0f));
  b.scene.settings.transparent_max_bounces = 0;
  EXPECT_NEAR(render(b.scene).pixel(3, 4).g, std::exp(-0.1 * 0.2 * 20), 1e-5);
}

// Density 1 + z in object space, from 0 to 2 along the box, times `factor`.
NodeGraph graded(const std::string& type, float factor = 1.0f) {
  GraphBuilder g("graded");
  const uint32_t coordinate = g.add("ShaderNodeTexCoord");
  const uint32_t parts = g.add("ShaderNodeSeparateXYZ");
  const uint32_t sum = g.add("ShaderNodeMath", {{"Value_001", {factor}}, {"Value_002", {factor}}},
                             {{"operation", "MULTIPLY_ADD"}});
  const bool absorbs = type == "ShaderNodeVolumeAbsorption";
  const uint32_t v = g.add(type, {{"Color", grey(absorbs ? 0.0f : 1.0f)}});
  g.link(coordinate, "Object", parts, "Vector").link(parts, "Z", sum, "Value");
  return g.link(sum, "Value", v, "Density").volume(v).build();
}

TEST(MediaStatistics, GradedSlabIsTheIntegralOfItsDensity) {
  SceneBuilder b = seen_from_above(1.0f);
  b.object(box(), graded("ShaderNodeVolumeAbsorption"), slab(1.0f));
  b.scene.settings.samples = 256;
  const Mean seen = mean_of(render(b.scene));
  EXPECT_NEAR(seen.value, std::exp(-2.0), 4.0 * seen.error + 0.01 * std::exp(-2.0));
  // A cube has more steps.
  b.scene.instances[0].object_to_world = k_identity34;
  const Mean cube = mean_of(render(b.scene));
  EXPECT_NEAR(cube.value, std::exp(-2.0), 4.0 * cube.error + 0.002 * std::exp(-2.0));
}

// Whatever is typed into a socket, and whatever the mesh: finite samples, and an end.
TEST(Media, ExtremesStayFinite) {
  const NodeGraph graphs[] = {
      scatter(1e30f, 0.9999f),
      scatter(1e10f, -5.0f),
      scatter(1e-30f),
      absorption(1e20f),
      volume("ShaderNodeVolumeScatter",
             {{"Color", {1e9f, 0.0f, -1.0f, 1.0f}}, {"Density", {1e9f}}, {"Anisotropy", {1.0f}}}),
      volume("ShaderNodeVolumePrincipled", {{"Density", {1e-6f}},
                                            {"Emission Strength", {1e20f}},
                                            {"Blackbody Intensity", {1e9f}},
                                            {"Temperature", {1e9f}}}),
  };
  for (const NodeGraph& graph : graphs) {
    SceneBuilder b;
    b.world(1.0f).ortho_camera(at(0.0f, 0.0f, 1.0f), 2.5f);  // on the boundary
    b.object(box(), graph);
    b.object(square(), graph, turned(30.0f, 0.3f, 0.0f, 0.2f));    // not closed
    b.object(box(), graph, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});  // flat
    b.lamp("POINT", 10.0f, at(0.1f, 0.1f, 0.5f)).radius = 0.0f;
    b.lamp("POINT", 10.0f, at(0.5f, 0.1f, 0.5f)).radius = 0.1f;
    b.scene.settings.samples = 4;
    RenderSession session(std::move(b.scene));
    session.start();
    ASSERT_TRUE(session.wait(60.0));
    EXPECT_EQ(session.error(), "");
    EXPECT_EQ(session.progress().dropped_samples, 0u) << graph.name;  // those not finite
  }
}

// What scatters everything and absorbs nothing cannot be seen in a uniform world.
struct FurnaceCase {
  const char* name;
  std::function<void(SceneBuilder&)> fill;
};

NodeGraph filled_glass(const std::string& distribution, float roughness, float ior, float sigma,
                       float g) {
  GraphBuilder graph("filled glass");
  const uint32_t surface = graph.add(
      "ShaderNodeBsdfGlass", {{"Color", grey(1.0f)}, {"Roughness", {roughness}}, {"IOR", {ior}}},
      {{"distribution", distribution}});
  const uint32_t v = graph.add("ShaderNodeVolumeScatter",
                               {{"Color", grey(1.0f)}, {"Density", {sigma}}, {"Anisotropy", {g}}});
  return graph.surface(surface).volume(v).build();
}

NodeGraph colored_scatter() {
  return volume("ShaderNodeVolumeScatter", {{"Color", {0.3f, 1.0f, 4.0f, 1.0f}}, {"Density", {1}}});
}

// A box of 12 voxels across, some empty and the others up to `density`.
void add_smoke(SceneBuilder& b, float density) {
  GridDesc grid;
  grid.name = "density";
  grid.width = grid.height = grid.depth = 12;
  grid.values = std::make_shared<std::vector<float>>();
  for (int i = 0; i < 12 * 12 * 12; ++i)
    grid.values->push_back(i % 3 == 0 ? density * static_cast<float>(i % 7) / 6.0f : 0.0f);
  b.scene.grids.push_back(grid);
  GraphBuilder graph("smoke");
  const uint32_t v = graph.add("ShaderNodeVolumePrincipled", {{"Color", grey(1.0f)}},
                               {{"density_attribute", "density"}});
  b.object(box(), graph.volume(v).build()).grids = {0};
}

const FurnaceCase k_furnaces[] = {
    {"isotropic", [](SceneBuilder& b) { b.object(sphere(), scatter(1.0f)); }},
    {"forward", [](SceneBuilder& b) { b.object(sphere(), scatter(2.0f, 0.9f)); }},
    {"backward", [](SceneBuilder& b) { b.object(box(), scatter(1.0f, -0.5f)); }},
    {"chromatic", [](SceneBuilder& b) { b.object(sphere(), colored_scatter()); }},
    {"graded", [](SceneBuilder& b) { b.object(box(), graded("ShaderNodeVolumeScatter")); }},
    {"dense_and_graded",
     [](SceneBuilder& b) { b.object(box(), graded("ShaderNodeVolumeScatter", 12.0f)); }},
    {"smoke", [](SceneBuilder& b) { add_smoke(b, 8.0f); }},
    {"overlapping",
     [](SceneBuilder& b) {
       b.object(sphere(), scatter(0.7f, 0.5f), at(0.5f, 0.0f, 0.0f));
       b.object(box(), scatter(0.5f, -0.3f), at(-0.4f, 0.0f, 0.3f));
     }},
    {"nested",
     [](SceneBuilder& b) {
       b.object(sphere(), scatter(0.5f));
       b.object(sphere(), scatter(2.0f, 0.5f), at(0.0f, 0.2f, 0.0f, 0.5f));
     }},
    {"many",
     [](SceneBuilder& b) {
       for (int i = 0; i < 27; ++i) {
         const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
         b.object(sphere(),
                  scatter(2.0f + 0.3f * static_cast<float>(i), 0.05f * static_cast<float>(i - 13)),
                  at(0.6f * static_cast<float>(x), 0.6f * static_cast<float>(y),
                     0.6f * static_cast<float>(z), 0.35f));
       }
     }},
    {"camera_inside",
     [](SceneBuilder& b) { b.object(sphere(), scatter(0.3f, 0.3f), at(0.0f, 0.0f, 0.0f, 7.0f)); }},
    {"smooth_glass",
     [](SceneBuilder& b) { b.object(sphere(), filled_glass("SHARP", 0.0f, 1.3f, 1.0f, 0.3f)); }},
    {"diffuse_inside",
     [](SceneBuilder& b) {
       b.object(sphere(), scatter(1.0f));
       b.object(sphere(), diffuse(1.0f), at(0.0f, 0.0f, 0.0f, 0.4f));
     }},
};

class MediaFurnaceStatistics : public ::testing::TestWithParam<FurnaceCase> {};

SceneBuilder white_world(int samples) {
  SceneBuilder b;
  b.world(1.0f).ortho_camera(at(0.0f, 0.0f, 5.0f), 2.0f);
  b.scene.settings.samples = samples;
  b.scene.settings.max_bounces = b.scene.settings.volume_bounces = 1024;
  b.scene.settings.transmission_bounces = b.scene.settings.glossy_bounces = 1024;
  b.scene.settings.diffuse_bounces = 1024;
  b.scene.settings.min_light_bounces = 1024;
  return b;
}

TEST_P(MediaFurnaceStatistics, WhiteMediumIsInvisible) {
  SceneBuilder b = white_world(512);
  GetParam().fill(b);
  expect_mean(mean_of(render(b.scene)), 1.0, 3e-3);
}

// Facets that are seen once only lose what they shadow: next to nothing where they are fine.
TEST(MediaRoughGlassStatistics, WhiteMediumIsInvisibleBehindFineFacets) {
  SceneBuilder b = white_world(2048);
  b.object(sphere(), filled_glass("BECKMANN", 0.08f, 1.1f, 1.0f, 0.3f));
  const Mean found = mean_of(render(b.scene));
  EXPECT_LT(found.error, 2e-4);
  EXPECT_NEAR(found.value, 1.0, 1e-3);
}

// With all that bounces between them nothing is lost on coarse ones either.
TEST(MediaRoughGlassStatistics, WhiteMediumIsInvisibleBehindCoarseFacets) {
  SceneBuilder b = white_world(8192);
  b.object(sphere(), filled_glass("MULTI_GGX", 0.3f, 1.2f, 1.0f, 0.3f));
  expect_mean(mean_of(render(b.scene)), 1.0, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Media, MediaFurnaceStatistics, ::testing::ValuesIn(k_furnaces),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace tenniel
