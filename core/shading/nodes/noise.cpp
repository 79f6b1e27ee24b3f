// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/noise.h"

#include <algorithm>
#include <cmath>

#include "math/hash.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr float k_max_detail = 15.0f;

float fade(float t) {
  return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

float signed_by(uint32_t bit, float x) {
  return bit ? -x : x;
}

float gradient(uint32_t hash, const NoisePoint<1>& d) {
  const uint32_t h = hash & 15u;
  return signed_by(h & 8u, 1.0f + static_cast<float>(h & 7u)) * d[0];
}

float gradient(uint32_t hash, const NoisePoint<2>& d) {
  const uint32_t h = hash & 7u;
  const float u = h < 4 ? d[0] : d[1];
  const float v = 2.0f * (h < 4 ? d[1] : d[0]);
  return signed_by(h & 1u, u) + signed_by(h & 2u, v);
}

float gradient(uint32_t hash, const NoisePoint<3>& d) {
  const uint32_t h = hash & 15u;
  const float u = h < 8 ? d[0] : d[1];
  const float v = h < 4 ? d[1] : h == 12 || h == 14 ? d[0] : d[2];
  return signed_by(h & 1u, u) + signed_by(h & 2u, v);
}

float gradient(uint32_t hash, const NoisePoint<4>& d) {
  const uint32_t h = hash & 31u;
  const float u = h < 24 ? d[0] : d[1];
  const float v = h < 16 ? d[1] : d[2];
  const float s = h < 8 ? d[2] : d[3];
  return signed_by(h & 1u, u) + signed_by(h & 2u, v) + signed_by(h & 4u, s);
}

uint32_t hash_cell(const std::array<uint32_t, 1>& c) {
  return hash_uint(c[0]);
}
uint32_t hash_cell(const std::array<uint32_t, 2>& c) {
  return hash_uint(c[0], c[1]);
}
uint32_t hash_cell(const std::array<uint32_t, 3>& c) {
  return hash_uint(c[0], c[1], c[2]);
}
uint32_t hash_cell(const std::array<uint32_t, 4>& c) {
  return hash_uint(c[0], c[1], c[2], c[3]);
}

// Gradient noise before scaling: the corners of the cell, folded axis by axis.
template <size_t n>
float raw_noise(const NoisePoint<n>& p) {
  std::array<uint32_t, n> cell;
  NoisePoint<n> local, weight;
  for (size_t axis = 0; axis < n; ++axis) {
    const float whole = std::floor(p[axis]);
    cell[axis] = static_cast<uint32_t>(clamp_to_int(whole));
    local[axis] = p[axis] - whole;
    weight[axis] = fade(local[axis]);
  }
  constexpr size_t k_corners = size_t{1} << n;
  std::array<float, k_corners> values;
  for (size_t corner = 0; corner < k_corners; ++corner) {
    std::array<uint32_t, n> at = cell;
    NoisePoint<n> offset = local;
    for (size_t axis = 0; axis < n; ++axis)
      if (corner >> axis & 1u) {
        ++at[axis];
        offset[axis] -= 1.0f;
      }
    values[corner] = gradient(hash_cell(at), offset);
  }
  size_t count = k_corners;
  for (size_t axis = 0; axis < n; ++axis) {
    count /= 2;
    for (size_t i = 0; i < count; ++i)
      values[i] = lerp(values[2 * i], values[2 * i + 1], weight[axis]);
  }
  return values[0];
}

template <size_t n>
NoisePoint<n> scaled(NoisePoint<n> p, float s) {
  for (float& x : p)
    x *= s;
  return p;
}

// A far away place of the lattice for each seed, so that channels do not look alike.
template <size_t n>
NoisePoint<n> seed_offset(float seed) {
  NoisePoint<n> offset;
  for (size_t axis = 0; axis < n; ++axis) {
    if constexpr (n == 1)
      offset[axis] = 100.0f + hash_float(seed) * 100.0f;
    else
      offset[axis] = 100.0f + hash_float(seed, static_cast<float>(axis)) * 100.0f;
  }
  return offset;
}

template <size_t n>
NoisePoint<n> plus(NoisePoint<n> a, const NoisePoint<n>& b) {
  for (size_t axis = 0; axis < n; ++axis)
    a[axis] += b[axis];
  return a;
}

}  // namespace

template <size_t n>
float signed_noise(const NoisePoint<n>& p) {
  constexpr std::array<float, 5> k_scale = {0.0f, 0.25f, 0.6616f, 0.982f, 0.8344f};
  const float noise = raw_noise(p) * k_scale[n];
  return std::isfinite(noise) ? noise : 0.0f;
}

template <size_t n>
float fractal_noise(NoisePoint<n> p, float detail, float roughness) {
  const float octaves = std::clamp(detail, 0.0f, k_max_detail);
  const float falloff = saturate(roughness);
  const int whole = static_cast<int>(octaves);
  float frequency = 1.0f, amplitude = 1.0f, sum = 0.0f, amplitudes = 0.0f;
  for (int i = 0; i <= whole; ++i) {
    sum += unit_noise(scaled(p, frequency)) * amplitude;
    amplitudes += amplitude;
    amplitude *= falloff;
    frequency *= 2.0f;
  }
  const float rest = octaves - static_cast<float>(whole);
  const float coarse = sum / amplitudes;
  if (rest == 0.0f) return coarse;
  const float next = unit_noise(scaled(p, frequency)) * amplitude;
  return lerp(coarse, (sum + next) / (amplitudes + amplitude), rest);
}

template <size_t n>
std::array<float, 3> noise_texture(NoisePoint<n> p, float detail, float roughness, float distortion,
                                   bool with_color) {
  // In one dimension the seeds count 0, 1, 2; in n the colours start at n.
  if (distortion != 0.0f) {
    NoisePoint<n> shift;
    for (size_t axis = 0; axis < n; ++axis)
      shift[axis] = signed_noise(plus(p, seed_offset<n>(static_cast<float>(axis)))) * distortion;
    p = plus(p, shift);
  }
  const float value = fractal_noise(p, detail, roughness);
  if (!with_color) return {value, value, value};
  constexpr auto k_seed = static_cast<float>(n);
  return {value, fractal_noise(plus(p, seed_offset<n>(k_seed)), detail, roughness),
          fractal_noise(plus(p, seed_offset<n>(k_seed + 1.0f)), detail, roughness)};
}

namespace {

// One octave after the other: frequency and amplitude of each.
struct Octaves {
  explicit Octaves(const MusgraveParameters& m)
      : lacunarity(std::max(m.lacunarity, 1e-5f)),
        falloff(std::pow(lacunarity, -std::max(m.dimension, 1e-5f))),
        count(static_cast<int>(std::clamp(m.detail, 0.0f, k_max_detail))),
        rest(std::clamp(m.detail, 0.0f, k_max_detail) - static_cast<float>(count)) {}
  float lacunarity, falloff;
  int count;
  float rest;  // of the octave after the last
};

template <size_t n>
float fbm(NoisePoint<n> p, const Octaves& octaves) {
  float sum = 0.0f, amplitude = 1.0f;
  for (int i = 0; i < octaves.count; ++i) {
    sum += signed_noise(p) * amplitude;
    amplitude *= octaves.falloff;
    p = scaled(p, octaves.lacunarity);
  }
  return octaves.rest != 0.0f ? sum + octaves.rest * signed_noise(p) * amplitude : sum;
}

template <size_t n>
float multifractal(NoisePoint<n> p, const Octaves& octaves) {
  float product = 1.0f, amplitude = 1.0f;
  for (int i = 0; i < octaves.count; ++i) {
    product *= amplitude * signed_noise(p) + 1.0f;
    amplitude *= octaves.falloff;
    p = scaled(p, octaves.lacunarity);
  }
  return octaves.rest != 0.0f ? product * (octaves.rest * amplitude * signed_noise(p) + 1.0f)
                              : product;
}

template <size_t n>
float hetero_terrain(NoisePoint<n> p, const Octaves& octaves, float offset) {
  float height = offset + signed_noise(p), amplitude = octaves.falloff;
  p = scaled(p, octaves.lacunarity);
  for (int i = 1; i < octaves.count; ++i) {
    height += (signed_noise(p) + offset) * amplitude * height;
    amplitude *= octaves.falloff;
    p = scaled(p, octaves.lacunarity);
  }
  if (octaves.rest == 0.0f) return height;
  return height + octaves.rest * (signed_noise(p) + offset) * amplitude * height;
}

template <size_t n>
float hybrid_multifractal(NoisePoint<n> p, const Octaves& octaves, float offset, float gain) {
  float value = 0.0f, amplitude = 1.0f, weight = 1.0f;
  for (int i = 0; weight > 0.001f && i < octaves.count; ++i) {
    weight = std::min(weight, 1.0f);
    const float signal = (signed_noise(p) + offset) * amplitude;
    value += weight * signal;
    weight *= gain * signal;
    amplitude *= octaves.falloff;
    p = scaled(p, octaves.lacunarity);
  }
  if (octaves.rest == 0.0f) return value;
  const float signal = (signed_noise(p) + offset) * amplitude;
  return value + octaves.rest * std::min(weight, 1.0f) * signal;
}

template <size_t n>
float ridged_multifractal(NoisePoint<n> p, const Octaves& octaves, float offset, float gain) {
  float signal = sqr(offset - std::abs(signed_noise(p)));
  float value = signal, amplitude = octaves.falloff;
  for (int i = 1; i < octaves.count; ++i) {
    p = scaled(p, octaves.lacunarity);
    const float weight = saturate(signal * gain);
    signal = sqr(offset - std::abs(signed_noise(p))) * weight;
    value += signal * amplitude;
    amplitude *= octaves.falloff;
  }
  return value;
}

}  // namespace

template <size_t n>
float musgrave(const NoisePoint<n>& p, const MusgraveParameters& m) {
  const Octaves octaves(m);
  switch (m.type) {
    case MusgraveType::fbm:
      return fbm(p, octaves);
    case MusgraveType::multifractal:
      return multifractal(p, octaves);
    case MusgraveType::hetero_terrain:
      return hetero_terrain(p, octaves, m.offset);
    case MusgraveType::hybrid_multifractal:
      return hybrid_multifractal(p, octaves, m.offset, m.gain);
    case MusgraveType::ridged_multifractal:
      return ridged_multifractal(p, octaves, m.offset, m.gain);
  }
  return 0.0f;
}

#define TENNIEL_NOISE_OF_DIMENSION(n)                                                       \
  template float signed_noise<n>(const NoisePoint<n>&);                                     \
  template float fractal_noise<n>(NoisePoint<n>, float, float);                             \
  template std::array<float, 3> noise_texture<n>(NoisePoint<n>, float, float, float, bool); \
  template float musgrave<n>(const NoisePoint<n>&, const MusgraveParameters&);
TENNIEL_NOISE_OF_DIMENSION(1)
TENNIEL_NOISE_OF_DIMENSION(2)
TENNIEL_NOISE_OF_DIMENSION(3)
TENNIEL_NOISE_OF_DIMENSION(4)
#undef TENNIEL_NOISE_OF_DIMENSION

}  // namespace tenniel
