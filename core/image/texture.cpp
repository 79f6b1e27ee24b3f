// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/colorspace.h"
#include "image/pixel_format.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

using Rgba = Texture::Rgba;

constexpr int k_first_tile = 1001, k_tile_columns = 10;

// sRGB decoding of [0, 1] by linear interpolation; off by less than 1e-6.
class SrgbTable {
 public:
  SrgbTable() {
    for (size_t i = 0; i < entries_.size(); ++i)
      entries_[i] = srgb_to_linear(static_cast<float>(i) / k_steps);
  }
  float decode(float c) const {
    if (!(c >= 0.0f && c < 1.0f)) return srgb_to_linear(c);
    const float x = c * k_steps;
    const auto i = static_cast<size_t>(x);
    return lerp(entries_[i], entries_[i + 1], x - static_cast<float>(i));
  }

 private:
  static constexpr float k_steps = 2048.0f;
  std::array<float, 2049> entries_;
};

const SrgbTable k_srgb_table;

// Index of texel `i` along a side of `n`, or -1 where there is none. `i` is at most a few texels
// outside, so that adding is cheaper than a division.
int wrap_texel(int i, int n, Extension extension) {
  switch (extension) {
    case Extension::repeat:
      while (i < 0)
        i += n;
      while (i >= n)
        i -= n;
      return i;
    case Extension::extend:
      return std::clamp(i, 0, n - 1);
    case Extension::clip:
      return i >= 0 && i < n ? i : -1;
  }
  return -1;
}

// Brings a coordinate so near to the picture that its texel index fits an int.
float near_picture(float x, Extension extension) {
  if (!std::isfinite(x)) return extension == Extension::clip ? -8.0f : 0.0f;
  return extension == Extension::repeat ? x - std::floor(x) : std::clamp(x, -8.0f, 9.0f);
}

// One axis of a filter: the first texel and how far the point lies beyond its centre.
struct AxisPosition {
  int first;
  float fraction;
};
AxisPosition texel_position(float x, int size, float center, Extension extension) {
  const float scaled = near_picture(x, extension) * static_cast<float>(size) - center;
  const float whole = std::floor(scaled);
  return {static_cast<int>(whole), scaled - whole};
}

template <class Format, int channels>
struct Texels {
  const typename Format::Stored* data;
  size_t width;

  Rgba at(int x, int y) const {
    if (x < 0 || y < 0) return {};
    const size_t index = (static_cast<size_t>(y) * width + static_cast<size_t>(x)) * channels;
    const auto* p = data + index;
    if constexpr (channels == 1) {
      const float grey = Format::load(p[0]);
      return {grey, grey, grey, 1.0f};
    } else {
      const float alpha = channels == 4 ? Format::load(p[channels - 1]) : 1.0f;
      return {Format::load(p[0]), Format::load(p[1]), Format::load(p[2]), alpha};
    }
  }
};

template <class Format, int channels>
Texels<Format, channels> texels_of(const Image& image) {
  const auto& pixels = std::get<std::vector<typename Format::Stored>>(image.pixels);
  return {pixels.data(), static_cast<size_t>(image.width)};
}

void accumulate(Rgba& sum, const Rgba& texel, float weight) {
  for (size_t c = 0; c < 4; ++c)
    sum[c] += texel[c] * weight;
}

template <class Format, int channels>
Rgba filter_closest(const Image& image, Vec2 uv, Extension extension) {
  const int x = texel_position(uv.x, image.width, 0.0f, extension).first;
  const int y = texel_position(uv.y, image.height, 0.0f, extension).first;
  return texels_of<Format, channels>(image).at(wrap_texel(x, image.width, extension),
                                               wrap_texel(y, image.height, extension));
}

template <class Format, int channels>
Rgba filter_linear(const Image& image, Vec2 uv, Extension extension) {
  const auto [x, s] = texel_position(uv.x, image.width, 0.5f, extension);
  const auto [y, t] = texel_position(uv.y, image.height, 0.5f, extension);
  const int x0 = wrap_texel(x, image.width, extension);
  const int x1 = wrap_texel(x + 1, image.width, extension);
  const int y0 = wrap_texel(y, image.height, extension);
  const int y1 = wrap_texel(y + 1, image.height, extension);
  const auto texels = texels_of<Format, channels>(image);
  Rgba sum{};
  accumulate(sum, texels.at(x0, y0), (1.0f - s) * (1.0f - t));
  accumulate(sum, texels.at(x1, y0), s * (1.0f - t));
  accumulate(sum, texels.at(x0, y1), (1.0f - s) * t);
  accumulate(sum, texels.at(x1, y1), s * t);
  return sum;
}

// Uniform cubic B-spline.
std::array<float, 4> cubic_weights(float t) {
  const float u = 1.0f - t;
  return {u * u * u / 6.0f, (3.0f * t * t * t - 6.0f * t * t + 4.0f) / 6.0f,
          (3.0f * u * u * u - 6.0f * u * u + 4.0f) / 6.0f, t * t * t / 6.0f};
}

template <class Format, int channels>
Rgba filter_cubic(const Image& image, Vec2 uv, Extension extension) {
  const auto [x, s] = texel_position(uv.x, image.width, 0.5f, extension);
  const auto [y, t] = texel_position(uv.y, image.height, 0.5f, extension);
  const std::array<float, 4> weights_x = cubic_weights(s), weights_y = cubic_weights(t);
  std::array<int, 4> columns;
  for (int i = 0; i < 4; ++i)
    columns[static_cast<size_t>(i)] = wrap_texel(x - 1 + i, image.width, extension);
  const auto texels = texels_of<Format, channels>(image);
  Rgba sum{};
  for (size_t j = 0; j < 4; ++j) {
    const int row = wrap_texel(y - 1 + static_cast<int>(j), image.height, extension);
    for (size_t i = 0; i < 4; ++i)
      accumulate(sum, texels.at(columns[i], row), weights_x[i] * weights_y[j]);
  }
  return sum;
}

template <class Format, int channels>
auto filter_of_channels(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::closest:
      return &filter_closest<Format, channels>;
    case Interpolation::cubic:
      return &filter_cubic<Format, channels>;
    case Interpolation::linear:
      break;
  }
  return &filter_linear<Format, channels>;
}

}  // namespace

Texture::Filter Texture::choose_filter(const Image& image, Interpolation interpolation) {
  return with_format(image, [&](auto format, const auto&) -> Filter {
    using Format = decltype(format);
    if (image.channels == 1) return filter_of_channels<Format, 1>(interpolation);
    if (image.channels == 3) return filter_of_channels<Format, 3>(interpolation);
    return filter_of_channels<Format, 4>(interpolation);
  });
}

Texture::Texture(std::shared_ptr<const Image> image, Interpolation interpolation,
                 Extension extension)
    : extension_(extension) {
  add(std::move(image), interpolation);
}

Texture::Texture(const std::map<int, std::shared_ptr<const Image>>& tiles,
                 Interpolation interpolation, Extension extension)
    : is_tiled_(true), extension_(extension) {
  for (const auto& [number, image] : tiles) {
    if (!image || number < k_first_tile || number > k_first_tile + 999) continue;
    const auto slot = static_cast<size_t>(number - k_first_tile);
    if (tile_sources_.size() <= slot) tile_sources_.resize(slot + 1, -1);
    tile_sources_[slot] = static_cast<int16_t>(sources_.size());
    add(image, interpolation);
  }
}

void Texture::add(std::shared_ptr<const Image> image, Interpolation interpolation) {
  const Filter filter = choose_filter(*image, interpolation);
  sources_.push_back({std::move(image), filter});
}

Texture::Rgba Texture::lookup(Vec2 uv, bool straight) const {
  const Source* source = sources_.data();
  if (is_tiled_) {
    const float column = std::floor(uv.x), row = std::floor(uv.y);
    if (!(column >= 0.0f && column < k_tile_columns && row >= 0.0f && row < 100.0f))
      return k_missing_image;
    const auto slot = static_cast<size_t>(column + k_tile_columns * row);
    if (slot >= tile_sources_.size() || tile_sources_[slot] < 0) return k_missing_image;
    source += tile_sources_[slot];
    uv = uv - Vec2{column, row};
  }
  const Image& image = *source->image;
  Rgba color = source->filter(image, uv, extension_);
  if (straight && image.is_associated && color[3] != 0.0f && color[3] != 1.0f)
    for (size_t c = 0; c < 3; ++c)
      color[c] /= color[3];
  if (image.is_srgb_encoded)
    for (size_t c = 0; c < 3; ++c)
      color[c] = k_srgb_table.decode(color[c]);
  return color;
}

}  // namespace tenniel
