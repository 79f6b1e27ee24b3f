// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/coordinates.h"

#include <algorithm>

#include "math/numeric.h"
#include "shading/nodes/vector.h"

namespace tenniel {

Vec3 map_vector(MappingType type, Vec3 v, Vec3 location, const Transform& turn, Vec3 scale) {
  const auto divided = [&](Vec3 a) {
    return by_component([](float x, float y) { return safe_divide(x, y); }, a, scale);
  };
  switch (type) {
    case MappingType::point:
      return turn.vector(v * scale) + location;
    case MappingType::texture:
      return divided(transposed(turn).vector(v - location));
    case MappingType::vector:
      return turn.vector(v * scale);
    case MappingType::normal:
      return normalize_or(turn.vector(divided(v)), {});
  }
  return v;
}

Vec3 apply_texture_mapping(const std::vector<float>& mapping, Vec3 v) {
  if (mapping.size() < 12) return v;
  const float* m = mapping.data();
  Vec3 mapped = {m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3],
                 m[4] * v.x + m[5] * v.y + m[6] * v.z + m[7],
                 m[8] * v.x + m[9] * v.y + m[10] * v.z + m[11]};
  if (mapping.size() < 18) return mapped;
  for (int i = 0; i < 3; ++i)
    mapped[i] = std::min(std::max(mapped[i], m[12 + i]), m[15 + i]);
  return mapped;
}

Vec2 sphere_projection(Vec3 p) {
  const Vec3 d = p * 2.0f - Vec3{1.0f, 1.0f, 1.0f};
  const float len = length(d);
  if (!(len > 0.0f)) return {};
  const bool on_axis = d.x == 0.0f && d.y == 0.0f;
  const float u = on_axis ? 0.0f : 0.5f - std::atan2(d.x, d.y) / k_two_pi;
  return {u, 1.0f - safe_acos(d.z / len) * k_inv_pi};
}

Vec2 tube_projection(Vec3 p) {
  const Vec3 d = p * 2.0f - Vec3{1.0f, 1.0f, 1.0f};
  if (d.x == 0.0f && d.y == 0.0f) return {};
  return {0.5f - std::atan2(d.x, d.y) / k_two_pi, (d.z + 1.0f) * 0.5f};
}

Vec2 equirectangular_projection(Vec3 direction) {
  const float len = length(direction);
  if (!(len > 0.0f)) return {};
  return {0.5f - fast_atan2(direction.y, direction.x) * (1.0f / k_two_pi),
          0.5f + fast_asin(direction.z / len) * k_inv_pi};
}

Vec2 mirror_ball_projection(Vec3 direction) {
  // The half vector between the direction and the one back to the viewer on -y.
  Vec3 d = normalize_or(direction, {});
  d.y -= 1.0f;
  const float scale = 2.0f * safe_sqrt(-0.5f * d.y);
  if (scale > 0.0f) d = d / scale;
  return {0.5f * (d.x + 1.0f), 0.5f * (d.z + 1.0f)};
}

namespace {

// The two axes share what lies between the borders of the band that `blend` opens.
void blend_pair(const Vec3& n, float blend, int a, int b, Vec3& weights) {
  const float share = n[a] / (n[a] + n[b]);
  weights[a] = saturate((share - 0.5f * (1.0f - blend)) / blend);
  weights[b] = 1.0f - weights[a];
}

}  // namespace

Vec3 box_weights(Vec3 normal, float blend) {
  Vec3 n = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const float sum = n.x + n.y + n.z;
  if (!(sum > 0.0f)) return {1.0f, 0.0f, 0.0f};
  n = n / sum;
  const float limit = 0.5f * (1.0f + blend), rest = 1.0f - limit;
  Vec3 weights;
  for (int a = 0; a < 3; ++a) {
    const float b = n[(a + 1) % 3], c = n[(a + 2) % 3];
    if (n[a] > limit * (n[a] + b) && n[a] > limit * (n[a] + c)) {
      weights[a] = 1.0f;
      return weights;
    }
  }
  // Only exact ties come here unblended; one of the faces has to win.
  if (!(blend > 0.0f)) return {1.0f, 0.0f, 0.0f};
  if (n.z < rest * (n.y + n.x))
    blend_pair(n, blend, 0, 1, weights);
  else if (n.x < rest * (n.y + n.z))
    blend_pair(n, blend, 1, 2, weights);
  else if (n.y < rest * (n.x + n.z))
    blend_pair(n, blend, 0, 2, weights);
  else
    weights = (n * (2.0f - limit) + Vec3{limit - 1.0f, limit - 1.0f, limit - 1.0f}) /
              (2.0f * limit - 1.0f);
  return weights;
}

Vec2 box_projection(Vec3 p, Vec3 normal, int axis) {
  if (axis == 0) return {normal.x < 0.0f ? 1.0f - p.y : p.y, p.z};
  if (axis == 1) return {normal.y > 0.0f ? 1.0f - p.x : p.x, p.z};
  return {normal.z > 0.0f ? 1.0f - p.y : p.y, p.x};
}

}  // namespace tenniel
