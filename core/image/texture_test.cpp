// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/colorspace.h"
#include "image/half.h"

namespace tenniel {
namespace {

std::shared_ptr<Image> float_image(int width, int height, int channels, std::vector<float> pixels) {
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  image->channels = channels;
  image->pixels = std::move(pixels);
  return image;
}

std::shared_ptr<Image> byte_image(int width, int height, int channels,
                                  std::vector<uint8_t> pixels) {
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  image->channels = channels;
  image->pixels = std::move(pixels);
  return image;
}

// Red runs along x, green along y: (0,0) (1,0) below, (0,1) (1,1) above.
std::shared_ptr<Image> two_by_two() {
  return float_image(2, 2, 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
}

float random_unit(uint32_t& state) {
  state = state * 1664525u + 1013904223u;
  return static_cast<float>(state >> 8) * 0x1p-24f;
}

TEST(Texture, LinearInterpolatesBetweenTexelCentres) {
  const Texture texture(two_by_two(), Interpolation::linear, Extension::extend);
  const auto c = texture.lookup({0.4375f, 0.5625f});  // agrees with Blender 3.4.1
  EXPECT_FLOAT_EQ(c[0], 0.375f);
  EXPECT_FLOAT_EQ(c[1], 0.625f);
  EXPECT_FLOAT_EQ(c[3], 1.0f);
  EXPECT_FLOAT_EQ(texture.lookup({0.25f, 0.25f})[0], 0.0f);
  EXPECT_FLOAT_EQ(texture.lookup({0.75f, 0.75f})[1], 1.0f);
}

TEST(Texture, RowZeroIsTheBottom) {
  const Texture texture(two_by_two(), Interpolation::closest, Extension::repeat);
  EXPECT_EQ(texture.lookup({0.1f, 0.1f})[1], 0.0f);
  EXPECT_EQ(texture.lookup({0.1f, 0.9f})[1], 1.0f);
}

TEST(Texture, ExtensionsDifferOutside) {
  const Texture repeat(two_by_two(), Interpolation::linear, Extension::repeat);
  const Texture extend(two_by_two(), Interpolation::linear, Extension::extend);
  const Texture clip(two_by_two(), Interpolation::linear, Extension::clip);
  EXPECT_FLOAT_EQ(repeat.lookup({0.0f, 0.25f})[0], 0.5f);
  EXPECT_FLOAT_EQ(extend.lookup({-3.0f, 0.25f})[0], 0.0f);
  EXPECT_FLOAT_EQ(extend.lookup({7.0f, 0.25f})[0], 1.0f);
  EXPECT_EQ(clip.lookup({1.5f, 0.25f}), (Texture::Rgba{0, 0, 0, 0}));
  // On the border itself half of the filter lies outside.
  EXPECT_FLOAT_EQ(clip.lookup({1.0f, 0.25f})[0], 0.5f);
  EXPECT_FLOAT_EQ(clip.lookup({1.0f, 0.25f})[3], 0.5f);
}

TEST(Texture, RepeatIsPeriodicForEveryInterpolation) {
  uint32_t state = 7;
  std::vector<float> pixels(5 * 3 * 4);
  for (float& v : pixels)
    v = random_unit(state);
  for (const auto interpolation :
       {Interpolation::linear, Interpolation::closest, Interpolation::cubic}) {
    const Texture texture(float_image(5, 3, 4, pixels), interpolation, Extension::repeat);
    for (int i = 0; i < 200; ++i) {
      const Vec2 uv{random_unit(state), random_unit(state)};
      const auto a = texture.lookup(uv), b = texture.lookup({uv.x - 2.0f, uv.y + 3.0f});
      // Near a border of `closest` the shifted coordinate may round into the next texel.
      const float fx = uv.x * 5.0f, fy = uv.y * 3.0f;
      const bool near_edge =
          std::abs(fx - std::round(fx)) < 1e-4f || std::abs(fy - std::round(fy)) < 1e-4f;
      if (interpolation == Interpolation::closest && near_edge) continue;
      for (size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(a[c], b[c], 1e-5f);
    }
  }
}

TEST(Texture, CubicKeepsConstantsAndStaysBetweenTexels) {
  const Texture flat(float_image(3, 3, 1, std::vector<float>(9, 0.7f)), Interpolation::cubic,
                     Extension::extend);
  EXPECT_NEAR(flat.lookup({0.31f, 0.77f})[2], 0.7f, 1e-6f);
  // At a texel centre a B-spline weighs 1/6, 4/6, 1/6.
  const Texture step(float_image(3, 1, 1, {0.0f, 1.0f, 0.0f}), Interpolation::cubic,
                     Extension::extend);
  EXPECT_NEAR(step.lookup({0.5f, 0.5f})[0], 4.0f / 6.0f, 1e-6f);
}

TEST(Texture, OneTexelImagesWorkEverywhere) {
  for (const auto interpolation :
       {Interpolation::linear, Interpolation::closest, Interpolation::cubic})
    for (const auto extension : {Extension::repeat, Extension::extend}) {
      const Texture texture(float_image(1, 1, 1, {0.25f}), interpolation, extension);
      EXPECT_NEAR(texture.lookup({-0.9f, 4.2f})[0], 0.25f, 1e-6f);
    }
}

TEST(Texture, SurvivesHugeAndNonFiniteCoordinates) {
  const float bad[] = {1e30f, -1e30f, std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN(), -1e-12f};
  for (const auto interpolation :
       {Interpolation::linear, Interpolation::closest, Interpolation::cubic})
    for (const auto extension : {Extension::repeat, Extension::extend, Extension::clip}) {
      const Texture texture(two_by_two(), interpolation, extension);
      for (const float x : bad)
        for (const float y : bad)
          for (const float value : texture.lookup({x, y}))
            EXPECT_TRUE(std::isfinite(value));
    }
}

TEST(Texture, SrgbBytesAreFilteredEncodedThenDecoded) {
  auto image = byte_image(2, 1, 3, {0, 0, 0, 255, 255, 255});
  image->is_srgb_encoded = true;
  const Texture texture(image, Interpolation::linear, Extension::extend);
  EXPECT_NEAR(texture.lookup({0.5f, 0.5f})[0], srgb_to_linear(0.5f), 1e-6f);
}

TEST(Texture, SrgbTableAgreesWithTheFormula) {
  auto image = float_image(2, 1, 1, {0.0f, 2.0f});
  image->is_srgb_encoded = true;
  const Texture texture(image, Interpolation::linear, Extension::extend);
  for (int i = 0; i <= 1000; ++i) {
    const float x = 0.25f + 0.5f * static_cast<float>(i) / 1000.0f;
    const float encoded = 2.0f * (x * 2.0f - 0.5f);
    EXPECT_NEAR(texture.lookup({x, 0.5f})[0], srgb_to_linear(encoded),
                2e-6f * std::max(1.0f, encoded));
  }
}

TEST(Texture, StraightDividesByAlphaUnlessChannelsAreIndependent) {
  auto image = float_image(1, 1, 4, {0.2f, 0.1f, 0.05f, 0.5f});
  const Texture texture(image, Interpolation::closest, Extension::repeat);
  EXPECT_FLOAT_EQ(texture.lookup({0.5f, 0.5f}, true)[0], 0.4f);
  EXPECT_FLOAT_EQ(texture.lookup({0.5f, 0.5f}, false)[0], 0.2f);
  image->is_associated = false;
  EXPECT_FLOAT_EQ(texture.lookup({0.5f, 0.5f}, true)[0], 0.2f);
}

TEST(Texture, HalfAndShortPixels) {
  auto image = std::make_shared<Image>();
  image->width = image->height = image->channels = 1;
  image->pixels = std::vector<uint16_t>{float_to_half(2.5f)};
  image->is_half = true;
  EXPECT_FLOAT_EQ(Texture(image, Interpolation::linear, Extension::repeat).lookup({0, 0})[0], 2.5f);
  auto shorts = std::make_shared<Image>(*image);
  shorts->pixels = std::vector<uint16_t>{65535};
  shorts->is_half = false;
  EXPECT_FLOAT_EQ(Texture(shorts, Interpolation::linear, Extension::repeat).lookup({0, 0})[1],
                  1.0f);
}

TEST(Texture, UdimTilesAreChosenByTheWholePart) {
  const auto grey = [](float v) { return float_image(1, 1, 1, {v}); };
  const Texture texture({{1001, grey(0.1f)}, {1002, grey(0.2f)}, {1011, grey(0.3f)}},
                        Interpolation::linear, Extension::extend);
  EXPECT_FLOAT_EQ(texture.lookup({0.5f, 0.5f})[0], 0.1f);
  EXPECT_FLOAT_EQ(texture.lookup({1.5f, 0.5f})[0], 0.2f);
  EXPECT_FLOAT_EQ(texture.lookup({0.5f, 1.5f})[0], 0.3f);
  for (const Vec2 outside : {Vec2{2.5f, 0.5f}, Vec2{-0.5f, 0.5f}, Vec2{10.5f, 0.5f},
                             Vec2{0.5f, 200.0f}, Vec2{std::nanf(""), 0.5f}})
    EXPECT_EQ(texture.lookup(outside), k_missing_image);
}

TEST(Half, RoundTripsEveryFiniteValue) {
  for (uint32_t h = 0; h < 0x10000u; ++h) {
    if ((h & 0x7c00u) == 0x7c00u) continue;
    EXPECT_EQ(float_to_half(half_to_float(static_cast<uint16_t>(h))), h);
  }
  EXPECT_EQ(half_to_float(0x3c00), 1.0f);
  EXPECT_EQ(half_to_float(0x0001), 0x1p-24f);
  EXPECT_EQ(half_to_float(0x7bff), 65504.0f);
  EXPECT_EQ(float_to_half_toward_zero(1.0f - 0x1p-13f), 0x3bff);
  EXPECT_EQ(float_to_half_toward_zero(-1.0f + 0x1p-13f), 0xbbff);
  EXPECT_EQ(float_to_half(1.0f + 0x1p-11f), 0x3c00);  // a tie goes to the even neighbour
}

}  // namespace
}  // namespace tenniel
