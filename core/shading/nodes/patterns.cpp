// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/patterns.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/math.h"
#include "shading/nodes/noise.h"

namespace tenniel {

namespace {

// Blender's nudge: keeps whole numbers on one side of a border whatever the rounding before.
Vec3 off_the_border(Vec3 p) {
  return {(p.x + 1e-6f) * 0.999999f, (p.y + 1e-6f) * 0.999999f, (p.z + 1e-6f) * 0.999999f};
}

int32_t whole(float x) {
  return clamp_to_int(std::floor(x));
}

}  // namespace

float checker(Vec3 scaled) {
  const Vec3 p = off_the_border(scaled);
  const int x = whole(p.x) & 1, y = whole(p.y) & 1, z = whole(p.z) & 1;
  return (x == y) == (z == 1) ? 1.0f : 0.0f;
}

float gradient_pattern(GradientType type, Vec3 p) {
  const float ball = std::max(0.999999f - length(p), 0.0f);
  float value = 0.0f;
  switch (type) {
    case GradientType::linear:
      value = p.x;
      break;
    case GradientType::quadratic:
      value = sqr(std::max(p.x, 0.0f));
      break;
    case GradientType::easing:
      value = smoothstep(saturate(p.x));
      break;
    case GradientType::diagonal:
      value = (p.x + p.y) * 0.5f;
      break;
    case GradientType::spherical:
      value = ball;
      break;
    case GradientType::quadratic_sphere:
      value = sqr(ball);
      break;
    case GradientType::radial:
      value = std::atan2(p.y, p.x) / k_two_pi + 0.5f;
      break;
  }
  return saturate(value);
}

namespace {

float wave_phase(const Vec3& p, const WaveParameters& w) {
  if (w.type == WaveType::bands) {
    switch (w.direction) {
      case WaveDirection::x:
        return p.x * 20.0f;
      case WaveDirection::y:
        return p.y * 20.0f;
      case WaveDirection::z:
        return p.z * 20.0f;
      case WaveDirection::diagonal:
        return (p.x + p.y + p.z) * 10.0f;
    }
  }
  Vec3 around = p;
  if (w.direction != WaveDirection::diagonal) around[static_cast<int>(w.direction)] = 0.0f;
  return length(around) * 20.0f;
}

}  // namespace

float wave(Vec3 scaled, const WaveParameters& w) {
  const Vec3 p = off_the_border(scaled);
  float n = wave_phase(p, w) + w.phase;
  if (w.distortion != 0.0f) {
    const NoisePoint<3> at = {p.x * w.detail_scale, p.y * w.detail_scale, p.z * w.detail_scale};
    n += w.distortion * (fractal_noise(at, w.detail, w.detail_roughness) * 2.0f - 1.0f);
  }
  switch (w.profile) {
    case WaveProfile::sine:
      return 0.5f + 0.5f * std::sin(n - 0.5f * k_pi);
    case WaveProfile::saw:
      return fraction(n / k_two_pi);
    case WaveProfile::triangle:
      return 2.0f * std::abs(n / k_two_pi - std::floor(n / k_two_pi + 0.5f));
  }
  return 0.0f;
}

namespace {

void turn_magic(float& x, float& y, float& z, int depth, float d) {
  const auto turn = [&](int level, float& axis, auto formula) {
    if (depth > level) axis = formula() * d;
  };
  turn(0, y, [&] { return -std::cos(x - y + z); });
  turn(1, x, [&] { return std::cos(x - y - z); });
  turn(2, z, [&] { return std::sin(-x - y - z); });
  turn(3, x, [&] { return -std::cos(-x + y - z); });
  turn(4, y, [&] { return -std::sin(-x + y + z); });
  turn(5, y, [&] { return -std::cos(-x + y + z); });
  turn(6, x, [&] { return std::cos(x + y + z); });
  turn(7, z, [&] { return std::sin(x + y - z); });
  turn(8, x, [&] { return -std::cos(-x - y + z); });
  turn(9, y, [&] { return -std::sin(x - y + z); });
}

}  // namespace

Spectrum magic(Vec3 p, float scale, int depth, float distortion) {
  const Vec3 a = {std::fmod(p.x, k_two_pi), std::fmod(p.y, k_two_pi), std::fmod(p.z, k_two_pi)};
  float x = std::sin((a.x + a.y + a.z) * 5.0f * scale);
  float y = std::cos((-a.x + a.y - a.z) * 5.0f * scale);
  float z = -std::cos((-a.x - a.y + a.z) * 5.0f * scale);
  if (depth > 0) {
    x *= distortion;
    y *= distortion;
    z *= distortion;
    turn_magic(x, y, z, depth, distortion);
  }
  if (distortion != 0.0f) {
    x /= distortion * 2.0f;
    y /= distortion * 2.0f;
    z /= distortion * 2.0f;
  }
  return {0.5f - x, 0.5f - y, 0.5f - z};
}

namespace {

// Blender's integer noise in [0, 1).
float brick_noise(uint32_t n) {
  n = (n + 1013u) & 0x7fffffffu;
  n = n >> 13 ^ n;
  const uint32_t m = (n * (n * n * 60493u + 19990303u) + 1376312589u) & 0x7fffffffu;
  return 0.5f * (static_cast<float>(m) / 1073741824.0f);
}

float mortar_at(float depth, const BrickParameters& b) {
  if (depth >= b.mortar_size) return 0.0f;
  if (b.mortar_smooth == 0.0f) return 1.0f;
  const float t = 1.0f - depth / b.mortar_size;
  return t < b.mortar_smooth ? smoothstep(saturate(t / b.mortar_smooth)) : 1.0f;
}

}  // namespace

BrickSample brick(Vec3 p, const BrickParameters& b) {
  const int row = whole(safe_divide(p.y, b.row_height));
  float width = b.width, offset = 0.0f;
  // The remainder of a negative row is negative, as Blender's is; only whether it is zero counts.
  if (b.offset_frequency > 0 && b.squash_frequency > 0) {
    if (row % b.squash_frequency == 0) width *= b.squash;
    if (row % b.offset_frequency == 0) offset = width * b.offset;
  }
  const int column = whole(safe_divide(p.x + offset, width));
  const float x = p.x + offset - width * static_cast<float>(column);
  const float y = p.y - b.row_height * static_cast<float>(row);
  const uint32_t seed =
      (static_cast<uint32_t>(row) << 16) + (static_cast<uint32_t>(column) & 0xffffu);
  const float depth = std::min(std::min(x, y), std::min(width - x, b.row_height - y));
  return {saturate(brick_noise(seed) + b.bias), mortar_at(depth, b)};
}

}  // namespace tenniel
