// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "math/vec.h"

namespace tenniel {

// Axis-aligned box; empty until something is added.
struct Bounds3 {
  Vec3 min{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
           std::numeric_limits<float>::max()};
  Vec3 max{std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
           std::numeric_limits<float>::lowest()};

  void add(Vec3 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  void add(const Bounds3& b) {
    if (b.is_empty()) return;
    add(b.min);
    add(b.max);
  }
  bool contains(Vec3 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z &&
           p.z <= max.z;
  }
  bool is_empty() const { return min.x > max.x; }
  Vec3 center() const { return (min + max) * 0.5f; }
  float radius() const { return is_empty() ? 0.0f : length(max - min) * 0.5f; }
};

}  // namespace tenniel
