// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "math/hash.h"
#include "math/lanes.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr float k_max_detail = 15.0f;

// What follows works on one point or, lane by lane, on eight; `Float` and `Uint` say on which.
float whole_part(float x) {
  return std::floor(x);
}
FloatLanes whole_part(FloatLanes x) {
  return each_lane(x, [](float lane) { return std::floor(lane); });
}

uint32_t cell_of(float whole) {
  return static_cast<uint32_t>(clamp_to_int(whole));
}
UintLanes cell_of(FloatLanes whole) {
  constexpr float k_least = -2147483648.0f, k_most = 2147483520.0f;
  whole = whole < k_most ? whole : FloatLanes{} + k_most;
  whole = whole > k_least ? whole : FloatLanes{} + k_least;
  using Int = decltype(whole < whole);
  return std::bit_cast<UintLanes>(__builtin_convertvector(whole, Int));
}

template <class Float>
Float fade(Float t) {
  return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// `x` with its sign turned where that bit of the hash is set.
template <class Float, class Uint>
Float signed_by(Uint hash, int bit, Float x) {
  return std::bit_cast<Float>(float_bits(x) ^ (hash >> bit & 1u) << 31);
}

float to_float(uint32_t x) {
  return static_cast<float>(x);
}
FloatLanes to_float(UintLanes x) {
  return __builtin_convertvector(x, FloatLanes);
}

template <class Uint, class Float>
Float gradient(Uint hash, const std::array<Float, 1>& d) {
  return signed_by(hash, 3, 1.0f + to_float(hash & 7u)) * d[0];
}

template <class Uint, class Float>
Float gradient(Uint hash, const std::array<Float, 2>& d) {
  const auto low = (hash & 7u) < 4u;
  const Float u = low ? d[0] : d[1];
  const Float v = 2.0f * (low ? d[1] : d[0]);
  return signed_by(hash, 0, u) + signed_by(hash, 1, v);
}

template <class Uint, class Float>
Float gradient(Uint hash, const std::array<Float, 3>& d) {
  const Uint h = hash & 15u;
  const Float u = h < 8u ? d[0] : d[1];
  const Float far = (h & 13u) == 12u ? d[0] : d[2];
  const Float v = h < 4u ? d[1] : far;
  return signed_by(h, 0, u) + signed_by(h, 1, v);
}

template <class Uint, class Float>
Float gradient(Uint hash, const std::array<Float, 4>& d) {
  const Uint h = hash & 31u;
  const Float u = h < 24u ? d[0] : d[1];
  const Float v = h < 16u ? d[1] : d[2];
  const Float s = h < 8u ? d[2] : d[3];
  return signed_by(h, 0, u) + signed_by(h, 1, v) + signed_by(h, 2, s);
}

// Gradient noise before scaling: the corners of the cell, folded axis by axis.
template <class Float, size_t n>
Float raw_noise(const std::array<Float, n>& p) {
  using Uint = decltype(float_bits(p[0]));
  std::array<Uint, n> cell;
  std::array<Float, n> local, weight;
  for (size_t axis = 0; axis < n; ++axis) {
    const Float whole = whole_part(p[axis]);
    cell[axis] = cell_of(whole);
    local[axis] = p[axis] - whole;
    weight[axis] = fade(local[axis]);
  }
  constexpr size_t k_corners = size_t{1} << n;
  std::array<Float, k_corners> values;
  for (size_t corner = 0; corner < k_corners; ++corner) {
    std::array<Uint, n> at = cell;
    std::array<Float, n> offset = local;
    for (size_t axis = 0; axis < n; ++axis)
      if (corner >> axis & 1u) {
        at[axis] += 1u;
        offset[axis] -= 1.0f;
      }
    const Uint hash = std::apply([](auto... c) { return hash_uint(c...); }, at);
    values[corner] = gradient(hash, offset);
  }
  size_t count = k_corners;
  for (size_t axis = 0; axis < n; ++axis) {
    count /= 2;
    for (size_t i = 0; i < count; ++i)
      values[i] = values[2 * i] * (1.0f - weight[axis]) + values[2 * i + 1] * weight[axis];
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

}  // namespace

namespace {

// What brings the noise of each number of dimensions to about [-1, 1].
constexpr std::array<float, 5> k_scale = {0.0f, 0.25f, 0.6616f, 0.982f, 0.8344f};

// `signed_noise` at a point and at its multiples by powers of a factor.
template <size_t n>
class OctaveNoise {
 public:
  OctaveNoise(NoisePoint<n> p, float factor, size_t count) {
    if (count < k_fewest_for_lanes) {
      for (size_t i = 0; i < count; ++i, p = scaled(p, factor))
        values_[i] = signed_noise(p);
      return;
    }
    std::array<std::array<float, k_most>, n> points;
    for (size_t i = 0; i < k_most && i < count + k_lanes; ++i, p = scaled(p, factor))
      for (size_t axis = 0; axis < n; ++axis)
        points[axis][i] = p[axis];
    for (size_t i = 0; i < count; i += k_lanes) {
      std::array<FloatLanes, n> at;
      for (size_t axis = 0; axis < n; ++axis)
        at[axis] = load_lanes(&points[axis][i]);
      const FloatLanes noise = raw_noise(at) * k_scale[n];
      const auto is_finite = noise - noise == 0.0f;
      store_lanes(is_finite ? noise : FloatLanes{}, &values_[i]);
    }
  }
  float operator[](size_t octave) const { return values_[octave]; }

 private:
  static constexpr size_t k_most = 3 * k_lanes;
#if defined(__AVX2__)
  static constexpr size_t k_fewest_for_lanes = 5;
#else
  static constexpr size_t k_fewest_for_lanes = k_most;  // halves of vectors bring nothing
#endif
  std::array<float, k_most> values_;
};

}  // namespace

template <size_t n>
float signed_noise(const NoisePoint<n>& p) {
  const float noise = raw_noise(p) * k_scale[n];
  return std::isfinite(noise) ? noise : 0.0f;
}

template <size_t n>
float fractal_noise(NoisePoint<n> p, float detail, float roughness) {
  const float octaves = std::clamp(detail, 0.0f, k_max_detail);
  const float falloff = saturate(roughness);
  const auto whole = static_cast<size_t>(octaves);
  const float rest = octaves - static_cast<float>(whole);
  const OctaveNoise<n> noise(p, 2.0f, whole + (rest == 0.0f ? 1 : 2));
  float amplitude = 1.0f, sum = 0.0f, amplitudes = 0.0f;
  for (size_t i = 0; i <= whole; ++i) {
    sum += (0.5f + 0.5f * noise[i]) * amplitude;
    amplitudes += amplitude;
    amplitude *= falloff;
  }
  const float coarse = sum / amplitudes;
  if (rest == 0.0f) return coarse;
  const float next = (0.5f + 0.5f * noise[whole + 1]) * amplitude;
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

struct Octaves {
  explicit Octaves(const MusgraveParameters& m)
      : lacunarity(std::max(m.lacunarity, 1e-5f)),
        falloff(std::pow(lacunarity, -std::max(m.dimension, 1e-5f))),
        count(static_cast<size_t>(std::clamp(m.detail, 0.0f, k_max_detail))),
        rest(std::clamp(m.detail, 0.0f, k_max_detail) - static_cast<float>(count)) {}
  float lacunarity, falloff;  // of frequency and amplitude from one octave to the next
  size_t count;
  float rest;  // of the octave after the last
};

// The sums take the octaves' noise one after the other.
template <size_t n>
float fbm(const OctaveNoise<n>& noise, const Octaves& octaves) {
  float sum = 0.0f, amplitude = 1.0f;
  for (size_t i = 0; i < octaves.count; ++i, amplitude *= octaves.falloff)
    sum += noise[i] * amplitude;
  return octaves.rest != 0.0f ? sum + octaves.rest * noise[octaves.count] * amplitude : sum;
}

template <size_t n>
float multifractal(const OctaveNoise<n>& noise, const Octaves& octaves) {
  float product = 1.0f, amplitude = 1.0f;
  for (size_t i = 0; i < octaves.count; ++i, amplitude *= octaves.falloff)
    product *= amplitude * noise[i] + 1.0f;
  return octaves.rest != 0.0f ? product * (octaves.rest * amplitude * noise[octaves.count] + 1.0f)
                              : product;
}

template <size_t n>
float hetero_terrain(const OctaveNoise<n>& noise, const Octaves& octaves, float offset) {
  float height = offset + noise[0], amplitude = octaves.falloff;
  for (size_t i = 1; i < octaves.count; ++i, amplitude *= octaves.falloff)
    height += (noise[i] + offset) * amplitude * height;
  if (octaves.rest == 0.0f) return height;
  const size_t last = std::max<size_t>(octaves.count, 1);
  return height + octaves.rest * (noise[last] + offset) * amplitude * height;
}

template <size_t n>
float hybrid_multifractal(const OctaveNoise<n>& noise, const Octaves& octaves, float offset,
                          float gain) {
  float value = 0.0f, amplitude = 1.0f, weight = 1.0f;
  size_t i = 0;
  for (; weight > 0.001f && i < octaves.count; ++i, amplitude *= octaves.falloff) {
    weight = std::min(weight, 1.0f);
    const float signal = (noise[i] + offset) * amplitude;
    value += weight * signal;
    weight *= gain * signal;
  }
  if (octaves.rest == 0.0f) return value;
  const float signal = (noise[i] + offset) * amplitude;
  return value + octaves.rest * std::min(weight, 1.0f) * signal;
}

template <size_t n>
float ridged_multifractal(const OctaveNoise<n>& noise, const Octaves& octaves, float offset,
                          float gain) {
  float signal = sqr(offset - std::abs(noise[0]));
  float value = signal, amplitude = octaves.falloff;
  for (size_t i = 1; i < octaves.count; ++i, amplitude *= octaves.falloff) {
    const float weight = saturate(signal * gain);
    signal = sqr(offset - std::abs(noise[i])) * weight;
    value += signal * amplitude;
  }
  return value;
}

}  // namespace

template <size_t n>
float musgrave(const NoisePoint<n>& p, const MusgraveParameters& m) {
  const Octaves octaves(m);
  // Some sums begin with an octave that they always have, and one may follow the last.
  const OctaveNoise<n> noise(p, octaves.lacunarity,
                             std::max<size_t>(octaves.count, 1) + (octaves.rest == 0.0f ? 0 : 1));
  switch (m.type) {
    case MusgraveType::fbm:
      return fbm(noise, octaves);
    case MusgraveType::multifractal:
      return multifractal(noise, octaves);
    case MusgraveType::hetero_terrain:
      return hetero_terrain(noise, octaves, m.offset);
    case MusgraveType::hybrid_multifractal:
      return hybrid_multifractal(noise, octaves, m.offset, m.gain);
    case MusgraveType::ridged_multifractal:
      return ridged_multifractal(noise, octaves, m.offset, m.gain);
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
