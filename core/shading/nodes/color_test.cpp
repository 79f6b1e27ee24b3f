// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/color.h"

#include <gtest/gtest.h>

#include "shading/nodes/blackbody.h"
#include "shading/nodes/ramp.h"

namespace tenniel {
namespace {

void expect_near(Spectrum a, Spectrum b, float tolerance = 2e-6f) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

const Spectrum k_a{0.2f, 0.6f, 1.0f}, k_b{0.5f, 0.0f, 0.25f};

struct BlendCase {
  BlendMode mode;
  Spectrum expected;  // at t = 0.5
};

class BlendTest : public testing::TestWithParam<BlendCase> {};

TEST_P(BlendTest, HalfAndNothing) {
  expect_near(mix_color(GetParam().mode, k_a, k_b, 0.5f), GetParam().expected);
  expect_near(mix_color(GetParam().mode, k_a, k_b, 0.0f), k_a);
}

// By hand from the definitions of the modes.
INSTANTIATE_TEST_SUITE_P(
    All, BlendTest,
    testing::Values(BlendCase{BlendMode::mix, {0.35f, 0.3f, 0.625f}},
                    BlendCase{BlendMode::darken, {0.2f, 0.3f, 0.625f}},
                    BlendCase{BlendMode::lighten, {0.35f, 0.6f, 1.0f}},
                    BlendCase{BlendMode::multiply, {0.15f, 0.3f, 0.625f}},
                    BlendCase{BlendMode::burn, {0.0f, 0.2f, 1.0f}},
                    BlendCase{BlendMode::screen, {0.4f, 0.6f, 1.0f}},
                    BlendCase{BlendMode::dodge, {0.2666667f, 0.6f, 1.0f}},
                    BlendCase{BlendMode::add, {0.45f, 0.6f, 1.125f}},
                    BlendCase{BlendMode::overlay, {0.2f, 0.4f, 1.0f}},
                    BlendCase{BlendMode::soft_light, {0.2f, 0.48f, 1.0f}},
                    BlendCase{BlendMode::linear_light, {0.2f, 0.1f, 0.75f}},
                    BlendCase{BlendMode::difference, {0.25f, 0.6f, 0.875f}},
                    BlendCase{BlendMode::subtract, {-0.05f, 0.6f, 0.875f}},
                    BlendCase{BlendMode::divide, {0.3f, 0.6f, 2.5f}},
                    // Hue of b is 11/12 of a turn, its saturation 1, its value 0.5.
                    BlendCase{BlendMode::hue, {0.6f, 0.4f, 0.8f}},
                    BlendCase{BlendMode::color, {0.6f, 0.3f, 0.75f}},
                    BlendCase{BlendMode::saturation, {0.1f, 0.55f, 1.0f}},
                    BlendCase{BlendMode::value, {0.15f, 0.45f, 0.75f}}));

TEST(Blend, GreyHasNoHueToGive) {
  expect_near(mix_color(BlendMode::hue, k_a, Spectrum(0.3f), 1.0f), k_a);
  expect_near(mix_color(BlendMode::color, k_a, Spectrum(0.3f), 1.0f), k_a);
}

TEST(ColorModels, KnownValues) {
  const Vec3 hsv = rgb_to_hsv({0.25f, 0.5f, 0.125f});
  EXPECT_NEAR(hsv.x, 1.0f / 6.0f * (2.0f - 1.0f / 3.0f), 1e-6f);
  EXPECT_FLOAT_EQ(hsv.y, 0.75f);
  EXPECT_FLOAT_EQ(hsv.z, 0.5f);
  const Vec3 hsl = rgb_to_hsl({0.25f, 0.5f, 0.125f});
  EXPECT_NEAR(hsl.x, hsv.x, 1e-6f);
  EXPECT_FLOAT_EQ(hsl.y, 0.6f);
  EXPECT_FLOAT_EQ(hsl.z, 0.3125f);
}

TEST(ColorModels, RoundTrip) {
  for (float r = 0.0f; r <= 1.0f; r += 0.125f)
    for (float g = 0.0f; g <= 1.0f; g += 0.125f)
      for (float b = 0.0f; b <= 1.0f; b += 0.125f) {
        expect_near(hsv_to_rgb(rgb_to_hsv({r, g, b})), {r, g, b});
        expect_near(hsl_to_rgb(rgb_to_hsl({r, g, b})), {r, g, b});
      }
}

TEST(ColorAdjustments, NeutralSettingsChangeNothing) {
  expect_near(adjust_hue(k_a, 0.5f, 1.0f, 1.0f, 1.0f), k_a);
  expect_near(brightness_contrast(k_a, 0.0f, 0.0f), k_a);
  expect_near(gamma_color(k_a, 1.0f), k_a);
  expect_near(invert_color(k_a, 0.0f), k_a);
}

TEST(ColorAdjustments, KnownValues) {
  // A third of a turn moves each channel on to the next.
  expect_near(adjust_hue(k_a, 0.5f + 1.0f / 3.0f, 1.0f, 1.0f, 1.0f), {1.0f, 0.2f, 0.6f}, 5e-6f);
  expect_near(adjust_hue(k_a, 0.5f, 0.0f, 0.5f, 1.0f), Spectrum(0.5f));
  expect_near(brightness_contrast(k_a, 0.1f, 1.0f), {0.0f, 0.8f, 1.6f});
  expect_near(gamma_color({0.25f, -1.0f, 4.0f}, 0.5f), {0.5f, -1.0f, 2.0f});
  expect_near(gamma_color(k_a, 0.0f), Spectrum(1.0f));
  expect_near(invert_color(k_a, 1.0f), {0.8f, 0.4f, 0.0f});
}

// Cycles 3.4.1 has tables fitted to other data, hence 3 %.
TEST(Blackbody, IsNearCycles) {
  expect_near(blackbody_color(1500.0f), {3.26431f, 0.43405f, 0.0f}, 1e-4f);
  expect_near(blackbody_color(3000.0f), {1.77084f, 0.84428f, 0.27222f}, 1e-4f);
  expect_near(blackbody_color(6500.0f), {1.04255f, 0.98405f, 1.03527f}, 1e-4f);
  expect_near(blackbody_color(13000.0f), {0.82629f, 0.99451f, 1.56631f}, 1e-4f);
  expect_near(blackbody_color(-5.0f), blackbody_color(799.0f), 0.0f);
  EXPECT_NEAR(luminance(blackbody_color(5000.0f)), 1.0f, 1e-3f);
}

TEST(Wavelength, IsNearCyclesAndBlackOutside) {
  expect_near(wavelength_color(450.0f), {0.05856f, 0.0f, 0.7478f}, 1e-4f);
  expect_near(wavelength_color(550.0f), {0.0f, 0.57417f, 0.0f}, 1e-4f);
  expect_near(wavelength_color(600.0f), {0.98082f, 0.06121f, 0.0f}, 1e-4f);
  expect_near(wavelength_color(200.0f), Spectrum(0.0f));
}

TEST(LookupTable, InterpolatesAndHoldsItsEnds) {
  const std::vector<float> table = {0.0f, 1.0f, 4.0f};
  EXPECT_FLOAT_EQ(lookup_table<1>(table, 0.25f, true, false)[0], 0.5f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, 0.75f, true, false)[0], 2.5f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, 0.75f, false, false)[0], 1.0f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, 2.0f, true, false)[0], 4.0f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, -2.0f, true, false)[0], 0.0f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, std::nanf(""), true, false)[0], 0.0f);
}

TEST(LookupTable, ExtrapolatesItsEndSegments) {
  const std::vector<float> table = {0.0f, 1.0f, 4.0f};
  EXPECT_FLOAT_EQ(lookup_table<1>(table, 1.5f, true, true)[0], 7.0f);
  EXPECT_FLOAT_EQ(lookup_table<1>(table, -1.0f, true, true)[0], -2.0f);
  EXPECT_EQ(lookup_table<1>({}, 0.5f, true, true)[0], 0.0f);
  EXPECT_EQ(lookup_table<4>({1, 2, 3, 4}, 9.0f, true, true)[3], 4.0f);
}

}  // namespace
}  // namespace tenniel
