// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "math/spectrum.h"
#include "math/vec.h"

// Regular patterns: pure functions of a coordinate.
namespace tenniel {

// 1 in the cells of the first colour, 0 in the others. `p` is scaled already.
float checker(Vec3 p);

enum class GradientType : uint8_t {
  linear,
  quadratic,
  easing,
  diagonal,
  spherical,
  quadratic_sphere,
  radial,
};
// In [0, 1].
float gradient_pattern(GradientType type, Vec3 p);

enum class WaveType : uint8_t { bands, rings };
enum class WaveDirection : uint8_t { x, y, z, diagonal };  // of rings the last is "spherical"
enum class WaveProfile : uint8_t { sine, saw, triangle };
struct WaveParameters {
  WaveType type = WaveType::bands;
  WaveDirection direction = WaveDirection::x;
  WaveProfile profile = WaveProfile::sine;
  float distortion = 0.0f, detail = 2.0f, detail_scale = 1.0f, detail_roughness = 0.5f;
  float phase = 0.0f;
};
// `p` is scaled already.
float wave(Vec3 p, const WaveParameters& parameters);

// `depth` turns the pattern into itself, at most 10 times.
Spectrum magic(Vec3 p, float scale, int depth, float distortion);

struct BrickParameters {
  float mortar_size = 0.02f, mortar_smooth = 0.1f, bias = 0.0f;
  float width = 0.5f, row_height = 0.25f;
  float offset = 0.5f, squash = 1.0f;
  int offset_frequency = 2, squash_frequency = 2;
};
struct BrickSample {
  float tint = 0.0f;    // of this brick, 0 = first colour, 1 = second
  float mortar = 0.0f;  // 1 in the mortar
};
// `p` is scaled already.
BrickSample brick(Vec3 p, const BrickParameters& parameters);

class NodeRegistry;
void register_noise_nodes(NodeRegistry& registry);  // of register_pattern_nodes

}  // namespace tenniel
