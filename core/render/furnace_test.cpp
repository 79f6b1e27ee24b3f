// SPDX-License-Identifier: Apache-2.0
// Whole pictures of scenes whose radiance is known in closed form.
#include <gtest/gtest.h>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// The mean lies within four standard errors of what theory says, and the error is small enough for
// that to mean something.
void expect_mean(const Picture& picture, double wanted, double least_precision = 0.01) {
  const Mean found = mean_of(picture);
  EXPECT_LT(found.error, least_precision * wanted + 1e-9);
  EXPECT_NEAR(found.value, wanted, 4.0 * found.error + 2e-4 * wanted);
}

SceneBuilder inside_a_sphere(NodeGraph graph) {
  SceneBuilder b;
  b.object(sphere(), std::move(graph));
  b.ortho_camera(turned(35.0f, 0.0f, 0.0f, 0.0f), 0.2f);
  return b;
}

// Radiance in a closed cavity that emits Le and reflects rho: Le (1 - rho^(n+1)) / (1 - rho) after
// n bounces.
TEST(FurnaceStatistics, GlowingSphereSumsTheGeometricSeries) {
  for (const int bounces : {0, 1, 3, 64}) {
    SceneBuilder b = inside_a_sphere(glowing_diffuse(0.5f, 0.5f));
    // Light met after the last bounce still counts: n bounces see n + 1 emitters behind each other.
    b.scene.settings.max_bounces = bounces;
    b.scene.settings.samples = 256;
    expect_mean(render(std::move(b.scene)), 1.0 - std::pow(0.5, bounces + 2));
  }
}

// A point lamp of intensity I in the middle of a unit sphere: every point is lit by I, reflects
// rho I / pi, and the interreflection makes it rho I / (pi (1 - rho)).
TEST(FurnaceStatistics, PointLampInADiffuseSphere) {
  SceneBuilder b = inside_a_sphere(diffuse(0.5f));
  b.lamp("POINT", 4.0f * 3.14159265f * 3.14159265f, k_identity34);
  b.scene.settings.samples = 256;
  // Facets lie a little nearer to the lamp than the sphere.
  expect_mean(render(std::move(b.scene)), 1.0 * 1.0, 0.01);
}

struct FurnaceCase {
  const char* name;
  NodeGraph graph;
};

class UniformWorldStatistics : public ::testing::TestWithParam<FurnaceCase> {};

// What neither absorbs nor emits cannot be seen in a uniform world.
TEST_P(UniformWorldStatistics, WhiteObjectIsInvisible) {
  SceneBuilder b;
  b.world(1.0f).ortho_camera(at(0.0f, 0.0f, 5.0f), 2.5f);
  b.object(sphere(), GetParam().graph);
  b.scene.settings.samples = 128;
  b.scene.settings.min_light_bounces = 64;
  expect_mean(render(std::move(b.scene)), 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Furnace, UniformWorldStatistics,
    ::testing::Values(
        FurnaceCase{"diffuse", diffuse(1.0f)}, FurnaceCase{"mirror", mirror()},
        FurnaceCase{"glass", glass(1.5f)},
        FurnaceCase{"translucent", single("ShaderNodeBsdfTranslucent", {{"Color", grey(1.0f)}})},
        FurnaceCase{"transparent", single("ShaderNodeBsdfTransparent", {{"Color", grey(1.0f)}})}),
    [](const auto& test) { return test.param.name; });

// Every path through white glass ends in the world with all it began with, however often it is
// reflected inside: what is missing has been dropped, or was cut off by a limit.
TEST(FurnaceStatistics, GlassSphereIsInvisibleToAThousandth) {
  for (const bool is_smooth : {true, false}) {
    for (const float ior : {1.1f, 1.5f, 2.4f}) {
      SceneBuilder b;
      b.world(1.0f).ortho_camera(at(0.0f, 0.0f, 5.0f), 2.0f);
      MeshDesc mesh = sphere();
      if (!is_smooth) mesh.smooth_flags = nullptr;
      b.object(std::move(mesh), glass(ior));
      b.scene.settings.samples = 1024;
      b.scene.settings.max_bounces = b.scene.settings.min_light_bounces = 1024;
      b.scene.settings.transmission_bounces = b.scene.settings.glossy_bounces = 1024;
      const Mean found = mean_of(render(std::move(b.scene)));
      EXPECT_NEAR(found.value, 1.0, 5e-4) << ior;
      EXPECT_LT(found.error, 2e-4) << ior;
    }
  }
}

// A plane in the light of a lamp looks the same whether the light is sampled, met by chance, or
// both, for diffuse and glossy surfaces.
TEST(EstimatorStatistics, LightSamplingAndChanceAgree) {
  for (const float roughness : {0.3f, 0.6f}) {
    const auto scene = [&](bool sampled, bool diffuse_floor) {
      SceneBuilder b;
      b.object(square(), diffuse_floor ? diffuse(0.8f) : glossy(roughness));
      b.object(square(), emission(4.0f), {0.4f, 0, 0, 0.3f, 0, 0.4f, 0, 0.2f, 0, 0, 0.4f, 0.9f});
      b.scene.materials[1].sample_as_light = sampled;
      b.ortho_camera(turned(40.0f, 0.0f, -0.8f, 1.0f), 0.3f);
      b.scene.settings.samples = 1024;
      b.scene.settings.max_bounces = 1;
      b.scene.instances[1].visibility.ray_kinds = 0x3e;  // not seen by the camera
      return render(std::move(b.scene));
    };
    for (const bool diffuse_floor : {true, false}) {
      const Mean sampled = mean_of(scene(true, diffuse_floor));
      const Mean chance = mean_of(scene(false, diffuse_floor));
      EXPECT_GT(sampled.value, 0.01);
      EXPECT_NEAR(sampled.value, chance.value,
                  4.0 * std::hypot(sampled.error, chance.error) + 1e-3 * chance.value);
    }
  }
}

// One shadow ray for all lamps: what they give together is the sum of what each gives alone, for
// few lamps and for so many that they are drawn by power, though some stand in the way of others.
TEST(EstimatorStatistics, LampsTogetherGiveTheirSum) {
  const auto scene = [](int lamps, int only) {
    SceneBuilder b;
    b.object(square(), diffuse(0.8f));
    b.object(sphere(), glossy(0.4f), at(0.1f, 0.0f, 0.3f, 0.2f));
    for (int i = 0; i < lamps; ++i) {
      if (only >= 0 && i % 3 != only) continue;
      const auto n = static_cast<float>(i);
      const float x = 1.2f * std::cos(2.4f * n), y = 1.2f * std::sin(2.4f * n);
      LightDesc& lamp = b.lamp(i % 2 == 0 ? "POINT" : "AREA", 1.0f + static_cast<float>(i % 4),
                               at(x, y, 0.6f + 0.02f * n));
      lamp.radius = 0.15f;
    }
    b.ortho_camera(at(0.0f, 0.0f, 5.0f), 1.0f);
    b.scene.settings.samples = 4096;
    b.scene.settings.max_bounces = 1;
    return mean_of(render(std::move(b.scene)));
  };
  for (const int lamps : {3, 7, 60}) {
    const Mean together = scene(lamps, -1);
    const Mean a = scene(lamps, 0), b = scene(lamps, 1), c = scene(lamps, 2);
    EXPECT_NEAR(together.value / (a.value + b.value + c.value), 1.0, 4e-3) << lamps;
  }
}

// Form factor of a unit square over the middle of a floor, at distance 1: 0.7522747 L irradiance.
TEST(EstimatorStatistics, SquareLampGivesTheClosedFormIrradiance) {
  SceneBuilder b;
  b.object(square(), diffuse(1.0f));
  // Radiance P / (4 A) = 1.
  LightDesc& lamp = b.lamp("AREA", 4.0f, at(0.0f, 0.0f, 1.0f));
  lamp.visibility.ray_kinds = 0x3e;
  b.ortho_camera(at(0.0f, 0.0f, 0.5f), 1e-3f);
  b.scene.settings.samples = 256;
  b.scene.settings.max_bounces = 0;
  expect_mean(render(std::move(b.scene)), 0.7522747 / 3.14159265, 1e-3);
}

TEST(Session, SameBitsForAnyNumberOfThreads) {
  const auto picture = [](int threads) {
    SceneBuilder b;
    b.world(0.3f);
    b.object(square(), diffuse(0.8f));
    b.object(sphere(), glossy(0.3f), at(0.0f, 0.0f, 0.5f, 0.5f));
    b.lamp("POINT", 50.0f, at(1.0f, 1.0f, 3.0f)).radius = 0.2f;
    b.scene.camera.camera_to_world = turned(50.0f, 0.0f, -4.0f, 3.0f);
    b.scene.settings.width = 70;
    b.scene.settings.height = 50;
    b.scene.settings.samples = 5;
    b.scene.settings.threads = threads;
    return render(std::move(b.scene)).rgba;
  };
  const auto one = picture(1);
  EXPECT_EQ(one, picture(2));
  EXPECT_EQ(one, picture(3));
}

TEST(Session, BorderIsACutOfTheWholePicture) {
  const auto scene = [] {
    SceneBuilder b;
    b.world(1.0f);
    b.object(sphere(), diffuse(0.5f), at(0.0f, 0.0f, -4.0f));
    b.scene.settings.width = 40;
    b.scene.settings.height = 30;
    b.scene.settings.samples = 4;
    return b.scene;
  };
  const Picture whole = render(scene());
  SceneDescription cut = scene();
  cut.settings.border_x = 13;
  cut.settings.border_y = 7;
  cut.settings.border_width = 20;
  cut.settings.border_height = 11;
  const std::vector<float> part = render_pass(cut, "Combined");
  ASSERT_EQ(part.size(), 20u * 11u * 4u);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(part[static_cast<size_t>(y * 20 + x) * 4], whole.pixel(x + 13, y + 7).r);
}

TEST(Session, CancelStopsAtOnceAndKeepsThePicture) {
  SceneBuilder b;
  b.world(1.0f);
  b.object(sphere(), diffuse(1.0f), at(0.0f, 0.0f, -4.0f));
  b.scene.settings.width = b.scene.settings.height = 64;
  b.scene.settings.samples = 1000000;
  RenderSession session(std::move(b.scene));
  session.start();
  while (session.progress().samples_done < 1 && !session.wait(0.01)) {
  }
  session.cancel();
  EXPECT_TRUE(session.wait(10.0));
  EXPECT_EQ(session.progress().stage, "Cancelled");
  EXPECT_EQ(session.error(), "");
  std::vector<float> pixels(64 * 64 * 4);
  ASSERT_TRUE(session.read_pass("Combined", {0, 0, 64, 64}, pixels.data(), pixels.size()));
  EXPECT_GT(pixels[0], 0.5f);
  EXPECT_FALSE(session.read_pass("Combined", {1, 0, 64, 64}, pixels.data(), pixels.size()));
  EXPECT_FALSE(session.read_pass("Nonsense", {0, 0, 64, 64}, pixels.data(), pixels.size()));
  session.close();
  session.close();
}

TEST(Session, TransparentFilmHasAlphaOnlyWhereThereIsSomething) {
  SceneBuilder b;
  b.world(1.0f).ortho_camera(at(0.0f, 0.0f, 5.0f), 4.0f);
  b.object(square(), diffuse(1.0f));
  b.scene.settings.film_transparent = true;
  const SceneDescription scene = b.scene;
  const Picture picture = render(scene);
  EXPECT_EQ(picture.alpha(0, 0), 0.0f);
  EXPECT_EQ(picture.alpha(4, 4), 1.0f);
  EXPECT_EQ(picture.pixel(0, 0).r, 0.0f);
  const std::vector<float> depth = render_pass(scene, "Depth");
  EXPECT_FLOAT_EQ(depth[4 * 8 + 4], 5.0f);
  EXPECT_EQ(depth[0], 1e10f);
  const std::vector<float> normal = render_pass(scene, "Normal");
  EXPECT_FLOAT_EQ(normal[(4 * 8 + 4) * 3 + 2], 1.0f);
}

}  // namespace
}  // namespace tenniel
