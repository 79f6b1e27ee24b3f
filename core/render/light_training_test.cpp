// SPDX-License-Identifier: Apache-2.0
#include "render/light_training.h"

#include <gtest/gtest.h>

#include <functional>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// A closed box with a block in it, lit by a small lamp: bright, dark and shadowed corners.
SceneDescription closed_box(int size, int samples) {
  SceneBuilder b;
  b.object(box(), diffuse(0.7f), at(0.0f, 0.0f, 0.0f, 2.0f));
  b.object(box(), diffuse(0.3f), at(0.6f, 0.4f, -1.4f, 0.6f));
  b.lamp("POINT", 100.0f, at(-1.2f, -1.0f, 1.5f)).radius = 0.05f;
  b.scene.camera.camera_to_world = turned(70.0f, 0.0f, -1.8f, 0.2f);
  b.scene.settings.width = b.scene.settings.height = size;
  b.scene.settings.samples = samples;
  return b.scene;
}

// Blocks on a floor under a World of one colour, which is met by chance alone.
SceneDescription open_blocks(int size, int samples) {
  SceneBuilder b;
  b.object(square(), diffuse(0.5f), at(0.0f, 0.0f, 0.0f, 4.0f));
  b.object(box(), diffuse(0.5f), at(0.6f, 0.4f, 0.6f, 0.6f));
  b.object(box(), diffuse(0.4f), at(-0.9f, 0.4f, 0.5f, 0.5f));
  b.world(1.0f);
  b.ortho_camera(turned(50.0f, 0.0f, -6.0f, 5.0f), 4.0f);
  b.scene.settings.width = b.scene.settings.height = size;
  b.scene.settings.samples = samples;
  return b.scene;
}

struct Comparison {
  double mean = 0.0, error = 0.0;  // of the differences, and its standard error
  double noise_without = 0.0, noise_with = 0.0;
};

// Two ways to play the roulette, against each other and each against a second seed.
Comparison compare(const std::function<SceneDescription(bool with)>& scene_of) {
  const auto picture = [&](bool with, uint32_t seed) {
    SceneDescription scene = scene_of(with);
    scene.settings.seed = seed;
    return render(std::move(scene));
  };
  const Picture without = picture(false, 1), without2 = picture(false, 2);
  const Picture with = picture(true, 3), with2 = picture(true, 4);
  Comparison c;
  double squares = 0.0;
  const int n = without.width * without.height;
  for (int i = 0; i < n; ++i) {
    const auto value = [&](const Picture& p) {
      return static_cast<double>(p.rgba[4u * static_cast<size_t>(i)]);
    };
    const double d = 0.5 * (value(with) + value(with2) - value(without) - value(without2));
    c.mean += d / n;
    squares += d * d / n;
    c.noise_without += std::pow(value(without) - value(without2), 2) / n;
    c.noise_with += std::pow(value(with) - value(with2), 2) / n;
  }
  c.error = std::sqrt(std::max(squares - c.mean * c.mean, 0.0) / n);
  return c;
}

TEST(LightTrainingStatistics, SamePictureWithAndWithoutTheCache) {
  const Comparison c = compare([](bool with) {
    SceneDescription scene = closed_box(64, 128);
    scene.settings.use_radiance_cache = with;
    return scene;
  });
  EXPECT_LT(std::abs(c.mean), 4.0 * c.error);
  EXPECT_GT(c.noise_with, 0.0);
  // The roulette spends its rays elsewhere, so the noise differs; it must not explode.
  EXPECT_LT(c.noise_with, 2.0 * c.noise_without);
}

// The roulette must not end a path before the World that it would have met.
TEST(LightTrainingStatistics, TheRouletteLeavesTheWorldAlone) {
  for (const bool with_cache : {true, false}) {
    const Comparison c = compare([&](bool with) {
      SceneDescription scene = open_blocks(64, 144);
      scene.settings.use_radiance_cache = with_cache;
      if (!with) scene.settings.min_light_bounces = 64;
      return scene;
    });
    EXPECT_LT(std::abs(c.mean), 4.0 * c.error) << with_cache;
    EXPECT_LT(c.noise_with, 1.5 * c.noise_without) << with_cache;
  }
}

TEST(LightTraining, SameBitsForAnyNumberOfThreadsAndAnyBorder) {
  const auto rendered = [](int threads) {
    SceneDescription scene = closed_box(256, 9);
    scene.settings.threads = threads;
    scene.settings.border_x = 100;
    scene.settings.border_y = 120;
    scene.settings.border_width = scene.settings.border_height = 24;
    return scene;
  };
  const std::vector<float> one = render_pass(rendered(1), "Combined");
  EXPECT_EQ(one, render_pass(rendered(3), "Combined"));
  SceneDescription moved = rendered(2);
  moved.settings.border_x += 8;
  moved.settings.border_width -= 8;
  const std::vector<float> part = render_pass(moved, "Combined");
  for (size_t y = 0; y < 24; ++y)
    for (size_t x = 0; x < 16 * 4; ++x)
      ASSERT_EQ(part[y * 16 * 4 + x], one[(y * 24 + 8) * 4 + x]);
  SceneDescription plain = rendered(2);
  plain.settings.use_radiance_cache = false;
  EXPECT_NE(one, render_pass(plain, "Combined"));  // it was at work
}

}  // namespace
}  // namespace tenniel
