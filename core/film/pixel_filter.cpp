// SPDX-License-Identifier: Apache-2.0
#include "film/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/numeric.h"

namespace tenniel {

namespace {

// Cycles' filters along one axis at `x` pixels from the centre, not normalised.
double filter_value(PixelFilter::Kind kind, double x, double width) {
  switch (kind) {
    case PixelFilter::Kind::box:
      return 1.0;
    case PixelFilter::Kind::gaussian:
      return std::exp(-8.0 * x * x / (width * width));
    case PixelFilter::Kind::blackman_harris: {
      const double t = 2.0 * std::numbers::pi * (x / (2.0 * width) + 0.5);
      return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) -
             0.01168 * std::cos(3.0 * t);
    }
  }
  return 0.0;
}

double filter_radius(PixelFilter::Kind kind, double width) {
  switch (kind) {
    case PixelFilter::Kind::box:
      return 0.5;
    case PixelFilter::Kind::gaussian:
      return 1.5 * width;  // six standard deviations
    case PixelFilter::Kind::blackman_harris:
      return width;
  }
  return 0.5;
}

}  // namespace

PixelFilter::PixelFilter(Kind kind, float width) {
  const double used_width = std::isfinite(width) ? std::clamp(double{width}, 0.01, 100.0) : 1.5;
  const double radius = filter_radius(kind, used_width);

  // tail[i]: integral from i * step to the end, midpoint rule; summed from the thin end.
  constexpr size_t k_steps = 16384;
  const double step = radius / k_steps;
  std::vector<double> tail(k_steps + 1, 0.0);
  for (size_t i = k_steps; i-- > 0;)
    tail[i] = tail[i + 1] + filter_value(kind, (static_cast<double>(i) + 0.5) * step, used_width);

  size_t cell = 0;
  for (size_t i = 0; i <= k_cells; ++i) {
    const double rest = sqr(1.0f - static_cast<float>(i) / k_cells);
    const double wanted = rest * tail[0];
    while (cell + 1 < k_steps && tail[cell + 1] > wanted)
      ++cell;
    const double in_cell = tail[cell] - tail[cell + 1];
    const double fraction = in_cell > 0.0 ? (tail[cell] - wanted) / in_cell : 1.0;
    offsets_[i] = static_cast<float>((static_cast<double>(cell) + fraction) * step);
  }
}

float PixelFilter::sample_axis(float u) const {
  const float signed_mass = 2.0f * u - 1.0f;  // of the side that it falls on
  const float position = (1.0f - safe_sqrt(1.0f - std::abs(signed_mass))) * k_cells;
  const int cell = std::min(static_cast<int>(position), k_cells - 1);
  const auto i = static_cast<size_t>(cell);
  const float offset = lerp(offsets_[i], offsets_[i + 1], position - static_cast<float>(cell));
  return std::copysign(offset, signed_mass);
}

}  // namespace tenniel
