// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

enum class BlendMode : uint8_t {
  mix,
  darken,
  multiply,
  burn,
  lighten,
  screen,
  dodge,
  add,
  overlay,
  soft_light,
  linear_light,
  difference,
  subtract,
  divide,
  hue,
  saturation,
  color,
  value,
};

// Blends `b` over `a` by `t`, which is not clamped.
Spectrum mix_color(BlendMode mode, Spectrum a, Spectrum b, float t);

Spectrum saturate(Spectrum c);

// Hue in turns, saturation and value (lightness for HSL), as x, y, z.
Vec3 rgb_to_hsv(Spectrum rgb);
Spectrum hsv_to_rgb(Vec3 hsv);
Vec3 rgb_to_hsl(Spectrum rgb);
Spectrum hsl_to_rgb(Vec3 hsl);

// Shifts the hue by `hue` - 0.5 turns and scales saturation and value; not below 0.
Spectrum adjust_hue(Spectrum c, float hue, float saturation, float value, float factor);
Spectrum brightness_contrast(Spectrum c, float brightness, float contrast);
Spectrum gamma_color(Spectrum c, float gamma);
constexpr Spectrum invert_color(Spectrum c, float factor) {
  return lerp(c, Spectrum(1.0f) - c, factor);
}

}  // namespace tenniel
