// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace tenniel {

// A radiometric value in linear Rec.709 RGB: radiance, albedo, throughput. Not a Vec3: the two
// never mix without a conversion that a reader can see.
struct Spectrum {
  float r = 0.0f, g = 0.0f, b = 0.0f;

  constexpr Spectrum() = default;
  constexpr Spectrum(float red, float green, float blue) : r(red), g(green), b(blue) {}
  constexpr explicit Spectrum(float grey) : r(grey), g(grey), b(grey) {}
};

constexpr Spectrum operator+(Spectrum a, Spectrum b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Spectrum operator-(Spectrum a, Spectrum b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Spectrum operator*(Spectrum a, Spectrum b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
constexpr Spectrum operator*(Spectrum a, float s) {
  return {a.r * s, a.g * s, a.b * s};
}
constexpr Spectrum operator*(float s, Spectrum a) {
  return a * s;
}
constexpr Spectrum operator/(Spectrum a, float s) {
  return a * (1.0f / s);
}
constexpr Spectrum& operator+=(Spectrum& a, Spectrum b) {
  return a = a + b;
}
constexpr Spectrum& operator*=(Spectrum& a, Spectrum b) {
  return a = a * b;
}
constexpr Spectrum& operator*=(Spectrum& a, float s) {
  return a = a * s;
}
constexpr bool operator==(Spectrum a, Spectrum b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

constexpr bool is_black(Spectrum a) {
  return a.r == 0.0f && a.g == 0.0f && a.b == 0.0f;
}
inline bool is_finite(Spectrum a) {
  return std::isfinite(a.r) && std::isfinite(a.g) && std::isfinite(a.b);
}
constexpr float max_component(Spectrum a) {
  return std::max(a.r, std::max(a.g, a.b));
}
constexpr float mean(Spectrum a) {
  return (a.r + a.g + a.b) * (1.0f / 3.0f);
}
// Rec.709 luminance, with the digits that Blender's colour to value conversion has.
constexpr float luminance(Spectrum a) {
  return 0.2126729f * a.r + 0.7151522f * a.g + 0.0721750f * a.b;
}
constexpr Spectrum lerp(Spectrum a, Spectrum b, float t) {
  return a * (1.0f - t) + b * t;
}

}  // namespace tenniel
