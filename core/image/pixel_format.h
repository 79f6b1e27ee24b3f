// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "image/half.h"
#include "image/image.h"

// How each kind of stored number becomes a float and back.
namespace tenniel {

struct ByteFormat {
  using Stored = uint8_t;
  static float load(Stored v) { return static_cast<float>(v) * (1.0f / 255.0f); }
  static Stored store(float x) {
    return static_cast<Stored>(std::lrint(std::clamp(x, 0.0f, 1.0f) * 255.0f));
  }
};

struct ShortFormat {
  using Stored = uint16_t;
  static float load(Stored v) { return static_cast<float>(v) * (1.0f / 65535.0f); }
  static Stored store(float x) {
    return static_cast<Stored>(std::lrint(std::clamp(x, 0.0f, 1.0f) * 65535.0f));
  }
};

struct HalfFormat {
  using Stored = uint16_t;
  static float load(Stored v) { return half_to_float(v); }
  static Stored store(float x) {
    return float_to_half_toward_zero(std::clamp(x, -65504.0f, 65504.0f));
  }
};

struct FloatFormat {
  using Stored = float;
  static float load(Stored v) { return v; }
  static Stored store(float x) { return x; }
};

// Calls `f(Format(), pixels)` for the format of `image`, pixels being its std::vector.
template <class AnyImage, class Function>
decltype(auto) with_format(AnyImage& image, Function&& f) {
  if (auto* bytes = std::get_if<std::vector<uint8_t>>(&image.pixels))
    return f(ByteFormat(), *bytes);
  if (auto* floats = std::get_if<std::vector<float>>(&image.pixels))
    return f(FloatFormat(), *floats);
  auto& shorts = std::get<std::vector<uint16_t>>(image.pixels);
  return image.is_half ? f(HalfFormat(), shorts) : f(ShortFormat(), shorts);
}

}  // namespace tenniel
