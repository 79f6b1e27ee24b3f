// SPDX-License-Identifier: Apache-2.0
#include "image/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "image/colorspace.h"
#include "image/half.h"
#include "testing/temporary_folder.h"

namespace tenniel {
namespace {

namespace fs = std::filesystem;

class ImageFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string make(const std::string& name, const std::string& bytes) const {
    return folder_.make(name, bytes);
  }
  void expect_refused(const std::string& file) const {
    const ImageLoadResult result = load_image(file, {});
    EXPECT_EQ(result.image, nullptr) << file;
    EXPECT_NE(result.error.find(file), std::string::npos) << result.error;
    EXPECT_EQ(result.error.back(), '.');
  }

 private:
  testing::TemporaryFolder folder_;
};

std::string big_endian(uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}
std::string little_endian(uint32_t v) {
  const std::string big = big_endian(v);
  return {big.rbegin(), big.rend()};
}

uint32_t png_crc(const std::string& bytes) {
  uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k)
      crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::string png_header(uint32_t width, uint32_t height) {
  const std::string chunk =
      "IHDR" + big_endian(width) + big_endian(height) + std::string("\x08\x06\x00\x00\x00", 5);
  return std::string("\x89PNG\r\n\x1a\n") + big_endian(13) + chunk + big_endian(png_crc(chunk)) +
         std::string(40, '\0');
}

std::string bmp_header(uint32_t width, uint32_t height) {
  return "BM" + little_endian(100) + little_endian(0) + little_endian(54) + little_endian(40) +
         little_endian(width) + little_endian(height) + std::string("\x01\x00\x18\x00", 4) +
         std::string(24, '\0') + std::string(40, '\x7f');
}

std::string tga_header(uint16_t width, uint16_t height) {
  std::string h(18, '\0');
  h[2] = 2;
  h[12] = static_cast<char>(width & 255);
  h[13] = static_cast<char>(width >> 8);
  h[14] = static_cast<char>(height & 255);
  h[15] = static_cast<char>(height >> 8);
  h[16] = 32;
  h[17] = 8;
  return h + std::string(80, '\x40');
}

std::string hdr_header(const std::string& resolution) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + std::string(40, '\x02');
}

TEST_F(ImageFile, LyingHeadersAreRefusedBeforeReading) {
  expect_refused(make("lie.png", png_header(60000, 60000)));
  expect_refused(make("lie.bmp", bmp_header(60000, 60000)));
  expect_refused(make("lie.tga", tga_header(60000, 60000)));
  expect_refused(make("lie.hdr", hdr_header("-Y 60000 +X 60000")));
}

TEST_F(ImageFile, EmptyPicturesAreRefused) {
  expect_refused(make("zero.png", png_header(0, 0)));
  expect_refused(make("zero.bmp", bmp_header(0, 0)));
  expect_refused(make("zero.tga", tga_header(0, 0)));
  expect_refused(make("zero.hdr", hdr_header("-Y 0 +X 0")));
}

TEST_F(ImageFile, WhatIsNoPictureIsRefused) {
  expect_refused(path("absent.png"));
  expect_refused(make("empty.exr", ""));
  expect_refused(make("text.jpg", "This is a letter, not a photograph.\n"));
  expect_refused(make("text.png", "neither is this"));
  expect_refused(make("short.tga", "abc"));
  fs::create_directories(path("folder.png"));
  expect_refused(path("folder.png"));
}

TEST_F(ImageFile, TruncatedFilesAreRefused) {
  std::vector<float> pixels(64 * 64 * 4, 1.0f);
  for (size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<float>(i * 2654435761u % 1000u) / 1000.0f;
  for (const char* name : {"whole.png", "whole.exr"}) {
    ASSERT_EQ(write_image(path(name), pixels.data(), 64, 64), "");
    ASSERT_NE(load_image(path(name), {}).image, nullptr);
    fs::resize_file(path(name), fs::file_size(path(name)) / 2);
    expect_refused(path(name));
  }
}

TEST_F(ImageFile, ExrRoundTripKeepsValuesAndRowOrder) {
  const std::vector<float> pixels = {0.0f, 0.5f, 2.0f, 1.0f, 0.25f, 0.125f, 0.0f, 0.5f,
                                     7.0f, 0.0f, 0.0f, 1.0f, 0.0f,  1e-4f,  0.0f, 0.0f};
  ASSERT_EQ(write_image(path("a.exr"), pixels.data(), 2, 2), "");
  EXPECT_FALSE(fs::exists(path("a.exr.part")));
  ImageLoadOptions options;
  options.colorspace = "Linear";
  const ImageLoadResult result = load_image(path("a.exr"), options);
  ASSERT_NE(result.image, nullptr) << result.error;
  EXPECT_EQ(result.image->channels, 4);
  EXPECT_FALSE(result.image->is_srgb_encoded);
  EXPECT_EQ(std::get<std::vector<float>>(result.image->pixels), pixels);
}

TEST_F(ImageFile, PngRoundTripIsStraightSrgbBytes) {
  // Linear 0.25 under alpha 0.5 is straight 0.5.
  const std::vector<float> pixels = {0.25f, 0.0f, 0.5f, 0.5f, 1.0f, 1.0f, 0.0f, 1.0f};
  ASSERT_EQ(write_image(path("a.png"), pixels.data(), 1, 2), "");
  ImageLoadOptions options;
  options.alpha = AlphaMode::channel_packed;
  const ImageLoadResult packed = load_image(path("a.png"), options);
  ASSERT_NE(packed.image, nullptr) << packed.error;
  const auto& bytes = std::get<std::vector<uint8_t>>(packed.image->pixels);
  EXPECT_EQ(bytes, (std::vector<uint8_t>{188, 0, 255, 128, 255, 255, 0, 255}));
  EXPECT_TRUE(packed.image->is_srgb_encoded);
  EXPECT_FALSE(packed.image->is_associated);

  const ImageLoadResult straight = load_image(path("a.png"), {});
  EXPECT_EQ(std::get<std::vector<uint8_t>>(straight.image->pixels)[0], 188 * 128 / 255);
  options.alpha = AlphaMode::none;
  EXPECT_EQ(load_image(path("a.png"), options).image->channels, 3);
  // The extension does not matter, the content does.
  fs::rename(path("a.png"), path("a.jpg"));
  EXPECT_NE(load_image(path("a.jpg"), {}).image, nullptr);
}

TEST_F(ImageFile, SizeLimitHalves) {
  const std::vector<float> pixels(static_cast<size_t>(100 * 40 * 4), 0.5f);
  ASSERT_EQ(write_image(path("a.exr"), pixels.data(), 100, 40), "");
  ImageLoadOptions options;
  options.colorspace = "Linear";
  options.size_limit = 32;
  const ImageLoadResult result = load_image(path("a.exr"), options);
  ASSERT_NE(result.image, nullptr);
  EXPECT_EQ(result.image->width, 25);
  EXPECT_EQ(result.image->height, 10);
  EXPECT_EQ(std::get<std::vector<float>>(result.image->pixels)[7], 0.5f);
}

TEST_F(ImageFile, WriteReportsWhatItCannotDo) {
  const std::vector<float> pixel = {0, 0, 0, 1};
  EXPECT_NE(write_image(path("none/a.exr"), pixel.data(), 1, 1), "");
  EXPECT_NE(write_image(path("a.gif"), pixel.data(), 1, 1), "");
  EXPECT_NE(write_image(path("a.exr"), pixel.data(), 0, 1), "");
  EXPECT_TRUE(fs::is_empty(fs::path(path("a.exr")).parent_path()));
}

Image raw_bytes(int channels, std::vector<uint8_t> pixels) {
  Image image;
  image.width = 1;
  image.height = static_cast<int>(pixels.size()) / channels;
  image.channels = channels;
  image.pixels = std::move(pixels);
  return image;
}

TEST(PrepareImage, GreyAndAlphaBecomesFourChannels) {
  const Image image = prepare_image(raw_bytes(2, {200, 255}), false, {});
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(std::get<0>(image.pixels), (std::vector<uint8_t>{200, 200, 200, 255}));
}

TEST(PrepareImage, DataIsLeftAlone) {
  ImageLoadOptions options;
  options.colorspace = "Non-Color";
  const Image image = prepare_image(raw_bytes(4, {10, 20, 30, 40}), false, options);
  EXPECT_EQ(std::get<0>(image.pixels), (std::vector<uint8_t>{10, 20, 30, 40}));
  EXPECT_FALSE(image.is_srgb_encoded);
  EXPECT_FALSE(image.is_associated);
}

TEST(PrepareImage, LinearBytesStayBytes) {
  ImageLoadOptions options;
  options.colorspace = "Linear";
  const Image image = prepare_image(raw_bytes(3, {10, 20, 30}), false, options);
  EXPECT_TRUE(std::holds_alternative<std::vector<uint8_t>>(image.pixels));
  EXPECT_FALSE(image.is_srgb_encoded);
}

TEST(PrepareImage, OtherSpacesAreConvertedToHalf) {
  ImageLoadOptions options;
  options.colorspace = "Linear ACEScg";
  const Image image = prepare_image(raw_bytes(4, {255, 255, 255, 51}), false, options);
  ASSERT_TRUE(image.is_half);
  const auto& halves = std::get<std::vector<uint16_t>>(image.pixels);
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(half_to_float(halves[c]), 0.2f, 1e-3f);
}

TEST(PrepareImage, NonFinitePixelsAreCleared) {
  Image raw;
  raw.width = raw.height = 1;
  raw.channels = 3;
  raw.pixels = std::vector<float>{std::nanf(""), std::numeric_limits<float>::infinity(), 2.0f};
  ImageLoadOptions options;
  options.colorspace = "Linear";
  const Image image = prepare_image(raw, true, options);
  EXPECT_EQ(std::get<std::vector<float>>(image.pixels), (std::vector<float>{0.0f, 0.0f, 2.0f}));
}

TEST(ImageFromPixels, KeepsBytesAndFloats) {
  const float pixels[] = {0.2f, 0.4f, 0.6f, 1.0f};
  const auto bytes = image_from_pixels(pixels, 1, 1, false, false, {});
  ASSERT_NE(bytes.image, nullptr);
  EXPECT_EQ(std::get<0>(bytes.image->pixels), (std::vector<uint8_t>{51, 102, 153, 255}));
  EXPECT_TRUE(bytes.image->is_srgb_encoded);
  const auto floats = image_from_pixels(pixels, 1, 1, true, true, {});
  ASSERT_NE(floats.image, nullptr);
  EXPECT_FALSE(floats.image->is_srgb_encoded);
  EXPECT_FLOAT_EQ(std::get<2>(floats.image->pixels)[1], 0.4f);
  EXPECT_EQ(image_from_pixels(pixels, 0, 0, true, true, {}).image, nullptr);
  EXPECT_EQ(image_from_pixels(nullptr, 1, 1, true, true, {}).image, nullptr);
}

TEST(ColorSpace, WhiteStaysWhite) {
  for (const char* name : {"sRGB", "Linear", "nuke_rec709", "Linear ACES", "Linear ACEScg"}) {
    float rgb[] = {1.0f, 1.0f, 1.0f};
    to_scene_linear(*find_colorspace(name), rgb);
    for (const float c : rgb)
      EXPECT_NEAR(c, 1.0f, 3e-4f) << name;
  }
}

// What Blender 3.4.1 makes of the same pixel.
TEST(ColorSpace, AcesAgreesWithBlender) {
  const float pixel[] = {0.484529f, 0.735357f, 0.854306f};
  const float aces[] = {0.056739f, 0.793276f, 0.878399f};
  const float acescg[] = {0.297732f, 0.766792f, 0.878733f};
  float a[3], b[3];
  std::copy_n(pixel, 3, a);
  std::copy_n(pixel, 3, b);
  to_scene_linear(*find_colorspace("Linear ACES"), a);
  to_scene_linear(*find_colorspace("Linear ACEScg"), b);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(a[c], aces[c], 1e-5f);
    EXPECT_NEAR(b[c], acescg[c], 1e-5f);
  }
}

TEST(PrepareImage, AlphaIsMultipliedInAfterConversion) {
  ImageLoadOptions options;
  options.colorspace = "nuke_rec709";
  const Image image = prepare_image(raw_bytes(4, {204, 0, 0, 51}), false, options);
  const float linear = decode_transfer(TransferCurve::rec709, 0.8f);
  const auto& halves = std::get<std::vector<uint16_t>>(image.pixels);
  EXPECT_NEAR(half_to_float(halves[0]), linear * 0.2f, 2e-4f);
}

TEST(ColorSpace, KnownNames) {
  EXPECT_TRUE(colorspace_is_supported("Filmic Log"));
  EXPECT_FALSE(colorspace_is_supported("Filmic sRGB"));
  EXPECT_NEAR(decode_transfer(TransferCurve::filmic_log, 0.606f), 0.18f, 1e-3f);
  EXPECT_NEAR(linear_to_srgb(srgb_to_linear(0.3f)), 0.3f, 1e-6f);
}

}  // namespace
}  // namespace tenniel
