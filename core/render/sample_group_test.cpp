// SPDX-License-Identifier: Apache-2.0
#include "render/sample_group.h"

#include <gtest/gtest.h>

#include "film/pixel_filter.h"
#include "integrator/path_integrator.h"
#include "scene/compile_scene.h"
#include "testing/render_scene.h"
#include "testing/scene_builder.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

using namespace testing;

TEST(SampleGroup, EachSampleIsInOneGroupHoweverTheyAreCut) {
  for (const uint32_t pass : {1u, 3u, 16u}) {
    for (uint32_t first = 0; first < 64;) {
      const uint32_t end = first / pass * pass + pass;
      const SampleGroup group = sample_group(first, end, true);
      EXPECT_EQ(group.first, first);
      ASSERT_GE(group.count, 1u);
      EXPECT_LE(group.count, k_max_branches);
      EXPECT_LE(first + group.count, end);
      // Every part of a group looks along the same ray, and the next along another.
      const SampleGroup last = sample_group(first + group.count - 1, end, true);
      EXPECT_EQ(group.camera_ray, last.camera_ray);
      first += group.count;
    }
  }
}

TEST(SampleGroup, CameraRaysFollowEachOther) {
  uint32_t ray = 0;
  for (uint32_t first = 0; first < 64; ++ray) {
    const SampleGroup group = sample_group(first, 64, true);
    EXPECT_EQ(group.camera_ray, ray);
    first += group.count;
  }
  EXPECT_EQ(ray, k_samples_alone + (64 - k_samples_alone) / k_max_branches);
  EXPECT_EQ(sample_group(40, 64, false).camera_ray, 40u);
  EXPECT_EQ(sample_group(40, 64, false).count, 1u);
}

// Balls of wax, rough glass and something painted on a floor: surfaces that scatter, pass on and
// let light in.
SceneDescription still_life() {
  SceneBuilder b;
  b.object(square(), diffuse(0.6f), at(0.0f, 0.0f, -0.7f, 4.0f));
  const auto ball = [&](NodeGraph graph, float x) {
    b.object(sphere(), std::move(graph), at(x, 0.0f, 0.0f, 0.7f));
  };
  ball(single("ShaderNodeSubsurfaceScattering",
              {{"Color", grey(0.2f)}, {"Scale", {0.1f}}, {"Radius", {1.0f, 0.5f, 0.2f}}},
              {{"falloff", std::string("RANDOM_WALK")}}, "BSSRDF"),
       -1.3f);
  ball(glossy(0.3f), 0.2f);
  ball(glass(1.45f), 1.7f);
  b.lamp("POINT", 300.0f, at(1.0f, 2.0f, 4.0f)).radius = 0.5f;
  b.world(0.2f);
  b.ortho_camera(turned(50.0f, 0.0f, -4.0f, 3.0f), 5.0f);
  return std::move(b.scene);
}

// As the second of two that share their beginning a sample is worth the same as alone.
TEST(SampleGroup, BothHaveTheMeanOfOneAlone) {
  SceneDescription description = still_life();
  const RenderSettings settings = description.settings;
  Diagnostics diagnostics;
  const auto scene = compile_scene(std::move(description), diagnostics, {});
  const PathIntegrator integrator(*scene, settings);
  Worker worker(*scene, settings);
  RunningStatistics alone, first, second;
  int alike = 0;
  constexpr int k_side = 160;
  for (int i = 0; i < k_side * k_side; ++i) {
    const int x = i % k_side, y = i / k_side;
    const Vec2 raster{8.0f * static_cast<float>(x) / k_side, 8.0f * static_cast<float>(y) / k_side};
    std::array<SampleResult, 2> results;
    worker.sampler.start_sample(x, y, 0);
    integrator.trace(raster, 0, std::span(results).first(1), worker);
    alone.add(mean(results[0].radiance));
    worker.sampler.start_sample(x, y, 1);
    integrator.trace(raster, 2, results, worker);
    first.add(mean(results[0].radiance));
    second.add(mean(results[1].radiance));
    EXPECT_EQ(results[0].depth, results[1].depth);
    alike += results[0].radiance == results[1].radiance ? 1 : 0;
  }
  EXPECT_GT(welch_test(alone, first), 1e-4) << alone.mean() << " " << first.mean();
  EXPECT_GT(welch_test(alone, second), 1e-4) << alone.mean() << " " << second.mean();
  EXPECT_LT(alike, k_side * k_side / 4);  // where they meet nothing
}

// A lamp that fills the left half of the picture, before a floor that is black for want of light.
SceneDescription edge_of_a_lamp() {
  SceneBuilder b;
  b.object(square(), diffuse(0.5f), at(0.0f, 0.0f, 0.0f, 4.0f));
  b.object(square(), emission(1.0f), at(-2.0f, 0.0f, 1.0f, 1.98f)).visibility = {1u, 1u};
  b.ortho_camera(at(0.0f, 0.0f, 5.0f), 1.0f);
  b.scene.settings.width = b.scene.settings.height = 9;
  b.scene.settings.samples = 64;
  return std::move(b.scene);
}

// The brightness of a pixel of it by 64 samples of which each looks for itself.
float seen_one_by_one(const Scene& scene, const RenderSettings& settings, int x, int y) {
  const PixelFilter filter(PixelFilter::Kind::box, 1.0f);
  const PathIntegrator integrator(scene, settings);
  Worker worker(scene, settings);
  float sum = 0.0f;
  for (uint32_t s = 0; s < 64; ++s) {
    worker.sampler.start_sample(x, y, s);
    const Vec2 u = worker.sampler.get_2d(), offset = s == 0 ? Vec2() : filter.sample(u);
    SampleResult result;
    integrator.trace(
        {static_cast<float>(x) + 0.5f + offset.x, static_cast<float>(y) + 0.5f + offset.y}, s,
        {&result, 1}, worker);
    sum += mean(result.radiance);
  }
  return sum / 64.0f;
}

TEST(SampleGroup, AtTheEdgeOfALampEachLooksForItself) {
  SceneDescription description = edge_of_a_lamp();
  const RenderSettings settings = description.settings;
  const Picture picture = render(edge_of_a_lamp());
  Diagnostics diagnostics;
  const auto scene = compile_scene(std::move(description), diagnostics, {});
  int on_edge = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float expected = seen_one_by_one(*scene, settings, x, y);
      EXPECT_NEAR(mean(picture.pixel(x, y)), expected, 1e-6f) << x << " " << y;
      on_edge += expected > 0.2f && expected < 0.8f ? 1 : 0;
    }
  }
  EXPECT_EQ(on_edge, picture.height);
}

}  // namespace
}  // namespace tenniel
