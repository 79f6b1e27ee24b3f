// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "image/image.h"
#include "math/vec.h"

namespace tenniel {

enum class Interpolation : uint8_t { linear, closest, cubic };
enum class Extension : uint8_t { repeat, extend, clip };

// A picture, or the tiles of a UDIM, as a function of (u, v). Const and thread-safe.
class Texture {
 public:
  using Rgba = std::array<float, 4>;

  // `image` has at least one pixel.
  Texture(std::shared_ptr<const Image> image, Interpolation interpolation, Extension extension);
  // UDIM: tile number (1001 + column + 10 * row) -> image. Where (u, v) lies in none of the tiles
  // the lookup is the colour of a missing image.
  Texture(const std::map<int, std::shared_ptr<const Image>>& tiles, Interpolation interpolation,
          Extension extension);

  // Scene-linear RGBA at (u, v); v runs up and (0, 0) is the lower left corner of the picture.
  // Colour is multiplied by alpha as stored in the image; `straight` divides it out again, unless
  // the image's channels are independent (`Image::is_associated` false).
  Rgba lookup(Vec2 uv, bool straight = false) const;

  int width() const { return sources_.empty() ? 0 : sources_.front().image->width; }
  int height() const { return sources_.empty() ? 0 : sources_.front().image->height; }
  bool is_associated() const { return !sources_.empty() && sources_.front().image->is_associated; }

 private:
  // The filter for one pixel format, chosen once so that the lookup itself does not branch on it.
  using Filter = Rgba (*)(const Image&, Vec2, Extension);
  struct Source {
    std::shared_ptr<const Image> image;
    Filter filter = nullptr;
  };
  void add(std::shared_ptr<const Image> image, Interpolation interpolation);
  static Filter choose_filter(const Image& image, Interpolation interpolation);

  std::vector<Source> sources_;
  std::vector<int16_t> tile_sources_;  // number - 1001 -> index in `sources_`, -1 = none
  bool is_tiled_ = false;
  Extension extension_;
};

// What Cycles shows for a missing image.
constexpr Texture::Rgba k_missing_image = {1.0f, 0.0f, 1.0f, 1.0f};

}  // namespace tenniel
