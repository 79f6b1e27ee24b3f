// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "math/vec.h"

namespace tenniel {

// Reconstruction filter by importance sampling (Ernst et al. 2006, "Filter Importance Sampling"):
// samples spread like the filter, each counts once and for one pixel only.
class PixelFilter {
 public:
  enum class Kind : uint8_t { box, gaussian, blackman_harris };

  // `width` in pixels as Blender's Filter Width; a box is one pixel wide whatever it says.
  PixelFilter(Kind kind, float width);

  // Offset from the pixel's centre in pixels; `u` in [0,1)^2.
  Vec2 sample(Vec2 u) const { return {sample_axis(u.x), sample_axis(u.y)}; }
  // Largest |offset| along an axis, in pixels.
  float radius() const { return offsets_.back(); }

 private:
  static constexpr int k_cells = 1024;
  float sample_axis(float u) const;

  // Offset at which the two-sided tail holds (1 - i / k_cells)^2 of the filter: the square puts the
  // cells densely where the tail is thin.
  std::array<float, k_cells + 1> offsets_;
};

}  // namespace tenniel
