// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "image/image.h"
#include "math/vec.h"

namespace tenniel {

enum class Interpolation : uint8_t { linear, closest, cubic };
enum class Extension : uint8_t { repeat, extend, clip };

// A sampled image, or the tiles of a UDIM. Const and thread-safe.
class Texture {
 public:
  Texture(std::shared_ptr<const Image> image, Interpolation interpolation, Extension extension);
  // UDIM: tile number (1001 + u + 10 v) -> image.
  Texture(std::map<int, std::shared_ptr<const Image>> tiles, Interpolation interpolation,
          Extension extension);

  // Scene-linear RGBA at (u, v), v up, colour associated with alpha unless the image says not.
  std::array<float, 4> lookup(Vec2 uv) const;
  int width() const;
  int height() const;
  bool is_associated() const;

 private:
  std::map<int, std::shared_ptr<const Image>> tiles_;  // one entry 0 when it is no UDIM
  const Image* single_ = nullptr;
  Interpolation interpolation_;
  Extension extension_;
};

}  // namespace tenniel
