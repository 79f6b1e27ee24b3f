// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// Perlin's gradient noise (Perlin 2002, "Improving Noise") over 1 to 4 dimensions with Blender's
// hash, gradients and scales, and the sums over octaves that Blender 3.4 builds from it.
namespace tenniel {

// A whole number as int; what does not fit (or is no number) becomes the nearest that does.
constexpr int32_t clamp_to_int(float whole) {
  if (!(whole > -2147483648.0f)) return INT32_MIN;
  return static_cast<int32_t>(whole < 2147483520.0f ? whole : 2147483520.0f);
}

// A point of 1 to 4 dimensions.
template <size_t n>
using NoisePoint = std::array<float, n>;

template <size_t n>
NoisePoint<n> plus(NoisePoint<n> a, const NoisePoint<n>& b) {
  for (size_t axis = 0; axis < n; ++axis)
    a[axis] += b[axis];
  return a;
}

// About [-1, 1]; 0 at every lattice point.
template <size_t n>
float signed_noise(const NoisePoint<n>& p);

template <size_t n>
float unit_noise(const NoisePoint<n>& p) {
  return 0.5f + 0.5f * signed_noise(p);
}

// Mean of octaves weighted by powers of `roughness`, in about [0, 1]; `detail` need not be whole.
template <size_t n>
float fractal_noise(NoisePoint<n> p, float detail, float roughness);

// The Noise Texture: value and the three channels of its colour (the first equals the value).
template <size_t n>
std::array<float, 3> noise_texture(NoisePoint<n> p, float detail, float roughness, float distortion,
                                   bool with_color);

enum class MusgraveType : uint8_t {
  multifractal,
  ridged_multifractal,
  hybrid_multifractal,
  fbm,
  hetero_terrain,
};

struct MusgraveParameters {
  MusgraveType type = MusgraveType::fbm;
  float detail = 2.0f, dimension = 2.0f, lacunarity = 2.0f, offset = 0.0f, gain = 1.0f;
};

// Ebert et al., "Texturing & Modeling", chapter 16, in Blender's variants.
template <size_t n>
float musgrave(const NoisePoint<n>& p, const MusgraveParameters& parameters);

}  // namespace tenniel
