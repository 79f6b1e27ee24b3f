// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

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

namespace detail {
// Everything but the sign of each channel.
constexpr std::array<uint32_t, 3> magnitude_bits(Spectrum a) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x) & 0x7fffffffu; };
  return {bits(a.r), bits(a.g), bits(a.b)};
}
}  // namespace detail

// Both are asked at every turn of a path: by their bits they take no branch for each channel.
constexpr bool is_black(Spectrum a) {
  const auto [r, g, b] = detail::magnitude_bits(a);
  return (r | g | b) == 0;
}
constexpr bool is_finite(Spectrum a) {
  const auto [r, g, b] = detail::magnitude_bits(a);
  return std::max(r, std::max(g, b)) < 0x7f800000u;
}
constexpr float max_component(Spectrum a) {
  return std::max(a.r, std::max(a.g, a.b));
}
// Each channel, or 0 where it is less.
constexpr Spectrum positive(Spectrum a) {
  return {std::max(a.r, 0.0f), std::max(a.g, 0.0f), std::max(a.b, 0.0f)};
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
