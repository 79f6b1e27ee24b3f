// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/color.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/math.h"

namespace tenniel {

namespace {

template <class Function>
Spectrum by_channel(Function f, Spectrum a, Spectrum b) {
  return {f(a.r, b.r), f(a.g, b.g), f(a.b, b.b)};
}

float overlay(float a, float b, float t) {
  if (a < 0.5f) return a * (1.0f - t + 2.0f * t * b);
  return 1.0f - (1.0f - t + 2.0f * t * (1.0f - b)) * (1.0f - a);
}

float dodge(float a, float b, float t) {
  if (a == 0.0f) return 0.0f;
  const float divisor = 1.0f - t * b;
  return divisor <= 0.0f ? 1.0f : std::min(a / divisor, 1.0f);
}

float burn(float a, float b, float t) {
  const float divisor = 1.0f - t + t * b;
  return divisor <= 0.0f ? 0.0f : saturate(1.0f - (1.0f - a) / divisor);
}

// A grey `b` has no hue to give and leaves `a` as it is.
Spectrum take_hue(Spectrum a, Spectrum b, float t, bool take_saturation) {
  const Vec3 from = rgb_to_hsv(b);
  if (from.y == 0.0f) return a;
  Vec3 hsv = rgb_to_hsv(a);
  hsv.x = from.x;
  if (take_saturation) hsv.y = from.y;
  return lerp(a, hsv_to_rgb(hsv), t);
}

Spectrum take_saturation_of(Spectrum a, Spectrum b, float t) {
  Vec3 hsv = rgb_to_hsv(a);
  if (hsv.y == 0.0f) return a;
  hsv.y = lerp(hsv.y, rgb_to_hsv(b).y, t);
  return hsv_to_rgb(hsv);
}

Spectrum take_value_of(Spectrum a, Spectrum b, float t) {
  Vec3 hsv = rgb_to_hsv(a);
  hsv.z = lerp(hsv.z, rgb_to_hsv(b).z, t);
  return hsv_to_rgb(hsv);
}

Spectrum mix_by_channel(BlendMode mode, Spectrum a, Spectrum b, float t) {
  const float s = 1.0f - t;
  switch (mode) {
    case BlendMode::darken:
      return by_channel([=](float x, float y) { return lerp(x, std::min(x, y), t); }, a, b);
    case BlendMode::lighten:
      return by_channel([=](float x, float y) { return lerp(x, std::max(x, y), t); }, a, b);
    case BlendMode::difference:
      return by_channel([=](float x, float y) { return lerp(x, std::abs(x - y), t); }, a, b);
    case BlendMode::burn:
      return by_channel([=](float x, float y) { return burn(x, y, t); }, a, b);
    case BlendMode::dodge:
      return by_channel([=](float x, float y) { return dodge(x, y, t); }, a, b);
    case BlendMode::screen:
      return by_channel([=](float x, float y) { return 1.0f - (s + t * (1.0f - y)) * (1.0f - x); },
                        a, b);
    case BlendMode::overlay:
      return by_channel([=](float x, float y) { return overlay(x, y, t); }, a, b);
    case BlendMode::soft_light:
      return by_channel(
          [=](float x, float y) {
            const float screen = 1.0f - (1.0f - y) * (1.0f - x);
            return s * x + t * ((1.0f - x) * y * x + x * screen);
          },
          a, b);
    case BlendMode::divide:
      return by_channel([=](float x, float y) { return y != 0.0f ? s * x + t * x / y : x; }, a, b);
    default:
      return lerp(a, b, t);
  }
}

}  // namespace

Spectrum saturate(Spectrum c) {
  return {saturate(c.r), saturate(c.g), saturate(c.b)};
}

Spectrum mix_color(BlendMode mode, Spectrum a, Spectrum b, float t) {
  switch (mode) {
    case BlendMode::mix:
      return lerp(a, b, t);
    case BlendMode::add:
      return a + b * t;
    case BlendMode::subtract:
      return a - b * t;
    case BlendMode::multiply:
      return lerp(a, a * b, t);
    case BlendMode::linear_light:
      return a + (2.0f * b - Spectrum(1.0f)) * t;
    case BlendMode::hue:
      return take_hue(a, b, t, false);
    case BlendMode::color:
      return take_hue(a, b, t, true);
    case BlendMode::saturation:
      return take_saturation_of(a, b, t);
    case BlendMode::value:
      return take_value_of(a, b, t);
    default:
      return mix_by_channel(mode, a, b, t);
  }
}

Vec3 rgb_to_hsv(Spectrum c) {
  const float high = max_component(c), low = std::min(c.r, std::min(c.g, c.b));
  const float range = high - low;
  const float saturation = high != 0.0f ? range / high : 0.0f;
  if (saturation == 0.0f) return {0.0f, 0.0f, high};
  float hue;
  if (c.r == high)
    hue = (c.g - c.b) / range;
  else if (c.g == high)
    hue = 2.0f + (c.b - c.r) / range;
  else
    hue = 4.0f + (c.r - c.g) / range;
  hue *= 1.0f / 6.0f;
  return {hue < 0.0f ? hue + 1.0f : hue, saturation, high};
}

Spectrum hsv_to_rgb(Vec3 hsv) {
  const float s = hsv.y, v = hsv.z;
  if (s == 0.0f) return Spectrum(v);
  const float h = (hsv.x == 1.0f ? 0.0f : hsv.x) * 6.0f;
  const float sector = std::floor(h);
  const float f = h - sector;
  const float p = v * (1.0f - s), q = v * (1.0f - s * f), t = v * (1.0f - s * (1.0f - f));
  if (sector == 0.0f) return {v, t, p};
  if (sector == 1.0f) return {q, v, p};
  if (sector == 2.0f) return {p, v, t};
  if (sector == 3.0f) return {p, q, v};
  if (sector == 4.0f) return {t, p, v};
  return {v, p, q};
}

Vec3 rgb_to_hsl(Spectrum c) {
  const float high = max_component(c), low = std::min(c.r, std::min(c.g, c.b));
  const float lightness = std::min(1.0f, (high + low) * 0.5f);
  const float range = high - low;
  if (range == 0.0f) return {0.0f, 0.0f, lightness};
  const float saturation =
      lightness > 0.5f ? safe_divide(range, 2.0f - high - low) : safe_divide(range, high + low);
  float hue;
  if (c.r == high)
    hue = (c.g - c.b) / range + (c.g < c.b ? 6.0f : 0.0f);
  else if (c.g == high)
    hue = 2.0f + (c.b - c.r) / range;
  else
    hue = 4.0f + (c.r - c.g) / range;
  return {hue * (1.0f / 6.0f), saturation, lightness};
}

Spectrum hsl_to_rgb(Vec3 hsl) {
  const float h = hsl.x * 6.0f;
  const Spectrum pure = {saturate(std::abs(h - 3.0f) - 1.0f), saturate(2.0f - std::abs(h - 2.0f)),
                         saturate(2.0f - std::abs(h - 4.0f))};
  const float chroma = (1.0f - std::abs(2.0f * hsl.z - 1.0f)) * hsl.y;
  return (pure - Spectrum(0.5f)) * chroma + Spectrum(hsl.z);
}

Spectrum adjust_hue(Spectrum c, float hue, float saturation, float value, float factor) {
  Vec3 hsv = rgb_to_hsv(c);
  hsv.x = fraction(hsv.x + hue + 0.5f);
  hsv.y = saturate(hsv.y * saturation);
  hsv.z *= value;
  const Spectrum mixed = lerp(c, hsv_to_rgb(hsv), factor);
  return positive(mixed);
}

Spectrum brightness_contrast(Spectrum c, float brightness, float contrast) {
  const float scale = 1.0f + contrast, offset = brightness - contrast * 0.5f;
  return {std::max(scale * c.r + offset, 0.0f), std::max(scale * c.g + offset, 0.0f),
          std::max(scale * c.b + offset, 0.0f)};
}

Spectrum gamma_color(Spectrum c, float gamma) {
  if (gamma == 0.0f) return Spectrum(1.0f);
  const auto raise = [gamma](float x) { return x > 0.0f ? std::pow(x, gamma) : x; };
  return {raise(c.r), raise(c.g), raise(c.b)};
}

}  // namespace tenniel
