// SPDX-License-Identifier: Apache-2.0
// Motion blur in whole pictures: how long something is where decides how bright it is there.
#include <gtest/gtest.h>

#include <limits>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// A glowing square of side 2 that moves along x by 4 while the shutter is open, seen from above.
SceneBuilder moving_square() {
  SceneBuilder b;
  InstanceDesc& object = b.object(square(), emission(3.0f));
  object.motion = {at(-2.0f, 0.0f, 0.0f), at(0.0f, 0.0f, 0.0f), at(2.0f, 0.0f, 0.0f)};
  b.ortho_camera(at(0.0f, 0.0f, 5.0f), 0.01f);
  b.scene.settings.samples = 1024;
  return b;
}

TEST(MotionBlur, BrightnessIsTheShareOfTime) {
  SceneBuilder b = moving_square();
  // Above x = 0 it is while its middle is within 1: half of the way.
  Mean found = mean_of(render(b.scene));
  EXPECT_NEAR(found.value, 1.5, 0.03);
  // Above x = 2.5 only while its middle is beyond 1.5: an eighth of it.
  b.ortho_camera(at(2.5f, 0.0f, 5.0f), 0.01f);
  found = mean_of(render(b.scene));
  EXPECT_NEAR(found.value, 3.0 / 8.0, 0.02);
  b.ortho_camera(at(3.2f, 0.0f, 5.0f), 0.01f);
  EXPECT_EQ(mean_of(render(b.scene)).value, 0.0);
}

TEST(MotionBlur, CameraThatMovesAlongSeesNoBlur) {
  SceneBuilder b = moving_square();
  b.ortho_camera(at(0.9f, 0.0f, 5.0f), 0.01f);
  b.scene.camera.motion = {at(-1.1f, 0.0f, 5.0f), at(2.9f, 0.0f, 5.0f)};
  EXPECT_NEAR(mean_of(render(b.scene)).value, 3.0, 1e-4);
}

TEST(MotionBlur, StepsThatAreNotNumbersAreLeftOut) {
  SceneBuilder b = moving_square();
  b.scene.instances[0].motion[1][3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(mean_of(render(b.scene)).value, 3.0, 1e-4);
}

// Shadows fall at the time of the path.
TEST(MotionBlur, ShadowsBlurToo) {
  const auto lit = [](bool moves) {
    SceneBuilder b;
    b.object(square(), diffuse(1.0f), at(0.0f, 0.0f, 0.0f, 20.0f));
    InstanceDesc& blocker = b.object(square(), diffuse(0.0f), at(100.0f, 0.0f, 2.0f));
    if (moves) blocker.motion = {at(-2.0f, 0.0f, 2.0f), at(2.0f, 0.0f, 2.0f)};
    b.lamp("SUN", 1.0f, k_identity34);
    b.ortho_camera(turned(45.0f, 0.0f, -5.0f, 5.0f), 0.01f);
    b.scene.settings.samples = 1024;
    b.scene.settings.max_bounces = 0;
    return mean_of(render(std::move(b.scene))).value;
  };
  EXPECT_NEAR(lit(true) / lit(false), 0.5, 0.02);
}

}  // namespace
}  // namespace tenniel
