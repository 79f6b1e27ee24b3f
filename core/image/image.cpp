// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/colorspace.h"
#include "image/pixel_format.h"

namespace tenniel {

namespace {

size_t pixel_count(const Image& image) {
  return static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
}

// Copies pixels into `channels` channels; `map` fills one from the other.
template <class Map>
void rechannel(Image& image, int channels, Map map) {
  with_format(image, [&](auto format, auto& pixels) {
    using Stored = typename decltype(format)::Stored;
    const size_t count = pixel_count(image);
    const auto from_stride = static_cast<size_t>(image.channels);
    const auto to_stride = static_cast<size_t>(channels);
    std::vector<Stored> mapped(count * to_stride);
    for (size_t i = 0; i < count; ++i)
      map(&pixels[i * from_stride], &mapped[i * to_stride]);
    pixels = std::move(mapped);
  });
  image.channels = channels;
}

void expand_grey_alpha(Image& image) {
  rechannel(image, 4, [](const auto* from, auto* to) {
    to[0] = to[1] = to[2] = from[0];
    to[3] = from[1];
  });
}

void drop_alpha(Image& image) {
  rechannel(image, 3, [](const auto* from, auto* to) { std::copy_n(from, 3, to); });
}

void clear_non_finite(Image& image) {
  if (auto* floats = std::get_if<std::vector<float>>(&image.pixels)) {
    for (float& v : *floats)
      if (!std::isfinite(v)) v = 0.0f;
  } else if (image.is_half) {
    for (uint16_t& v : std::get<std::vector<uint16_t>>(image.pixels))
      if ((v & 0x7c00u) == 0x7c00u) v = 0;
  }
}

// Integers as halves, so that a colour conversion neither clips nor bands.
void integers_to_half(Image& image) {
  if (image.is_half || std::holds_alternative<std::vector<float>>(image.pixels)) return;
  std::vector<uint16_t> halves;
  with_format(image, [&](auto format, const auto& pixels) {
    halves.resize(pixels.size());
    std::transform(pixels.begin(), pixels.end(), halves.begin(),
                   [&](auto v) { return HalfFormat::store(format.load(v)); });
  });
  image.pixels = std::move(halves);
  image.is_half = true;
}

// Conversion acts on straight colour: alpha is divided out before where the source is associated,
// and multiplied in after where the image shall be, all in one rounding.
void convert_colors(Image& image, const ColorSpace& space, bool source_is_associated) {
  with_format(image, [&](auto format, auto& pixels) {
    const auto stride = static_cast<size_t>(image.channels);
    const bool has_alpha = stride == 4 && image.is_associated;
    for (size_t i = 0; i < pixels.size(); i += stride) {
      float rgb[3];
      for (size_t c = 0; c < 3; ++c)
        rgb[c] = format.load(pixels[i + (stride == 1 ? 0 : c)]);
      const float alpha = has_alpha ? format.load(pixels[i + 3]) : 1.0f;
      if (source_is_associated && alpha > 0.0f)
        for (float& c : rgb)
          c /= alpha;
      to_scene_linear(space, rgb);
      const float coverage = source_is_associated && alpha <= 0.0f ? 1.0f : alpha;
      for (size_t c = 0; c < std::min<size_t>(stride, 3); ++c)
        pixels[i + c] = format.store(rgb[c] * coverage);
    }
  });
}

void associate_alpha(Image& image) {
  with_format(image, [&](auto format, auto& pixels) {
    using Stored = typename decltype(format)::Stored;
    constexpr bool is_normalized = !std::is_same_v<decltype(format), HalfFormat> &&
                                   !std::is_same_v<decltype(format), FloatFormat>;
    for (size_t i = 0; i < pixels.size(); i += 4) {
      for (size_t c = i; c < i + 3; ++c) {
        if constexpr (is_normalized) {
          // Truncated like Cycles, so that soft edges agree to the last bit.
          const uint64_t product = uint64_t{pixels[c]} * pixels[i + 3];
          pixels[c] = static_cast<Stored>(product / std::numeric_limits<Stored>::max());
        } else {
          pixels[c] = format.store(format.load(pixels[c]) * format.load(pixels[i + 3]));
        }
      }
    }
  });
}

// Mean of 2 x 2 pixels; an odd last row or column joins its neighbour.
Image half_size(const Image& image) {
  Image result = image;
  result.width = std::max(image.width / 2, 1);
  result.height = std::max(image.height / 2, 1);
  with_format(image, [&](auto format, const auto& pixels) {
    using Stored = typename decltype(format)::Stored;
    const auto stride = static_cast<size_t>(image.channels);
    std::vector<Stored> mean(pixel_count(result) * stride);
    const auto at = [&](int x, int y, size_t c) {
      const size_t row = static_cast<size_t>(std::min(y, image.height - 1));
      const size_t column = static_cast<size_t>(std::min(x, image.width - 1));
      return format.load(pixels[(row * static_cast<size_t>(image.width) + column) * stride + c]);
    };
    size_t i = 0;
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x)
        for (size_t c = 0; c < stride; ++c)
          mean[i++] = format.store(0.25f * (at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) +
                                            at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c)));
    result.pixels = std::move(mean);
  });
  return result;
}

}  // namespace

size_t Image::memory_bytes() const {
  return std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, pixels);
}

Image prepare_image(Image raw, bool file_is_associated, const ImageLoadOptions& options) {
  static const ColorSpace srgb{false, TransferCurve::srgb, nullptr};
  const ColorSpace* named = find_colorspace(options.colorspace);
  const ColorSpace& space = named ? *named : srgb;
  const bool is_data = options.is_data || space.is_data;

  Image image = std::move(raw);
  if (image.channels == 2) expand_grey_alpha(image);
  if (image.channels == 4 && options.alpha == AlphaMode::none) drop_alpha(image);
  clear_non_finite(image);

  if (image.channels == 4 && (is_data || options.alpha == AlphaMode::channel_packed))
    image.is_associated = false;
  image.is_srgb_encoded = !is_data && space.curve == TransferCurve::srgb;
  const bool must_convert = !is_data && !image.is_srgb_encoded && !space.is_scene_linear();
  // Whether to multiply by alpha is asked of the file and not of the image's alpha mode, as in
  // Cycles.
  if (must_convert) {
    integers_to_half(image);
    convert_colors(image, space, file_is_associated);
  } else if (image.channels == 4 && image.is_associated && !file_is_associated) {
    associate_alpha(image);
  }

  while (options.size_limit > 0 && std::max(image.width, image.height) > options.size_limit)
    image = half_size(image);
  return image;
}

}  // namespace tenniel
