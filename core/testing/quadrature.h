// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

// Numerical integration for tests, in double precision.
namespace tenniel::testing {

struct Rectangle {
  double x0 = 0.0, x1 = 1.0, y0 = 0.0, y1 = 1.0;

  double area() const { return (x1 - x0) * (y1 - y0); }
  // Quarters in the order (low, low), (high, low), (low, high), (high, high).
  std::array<Rectangle, 4> quarters() const {
    const double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
    return {{{x0, x, y0, y}, {x, x1, y0, y}, {x0, x, y, y1}, {x, x1, y, y1}}};
  }
};

// 3 x 3 Gauss-Legendre points: exact for polynomials of degree 5 in each variable.
template <class Function>
double gauss_3x3(const Function& f, const Rectangle& r) {
  constexpr double k_offset = 0.38729833462074168852;  // sqrt(3/5) / 2
  constexpr std::array<double, 3> k_weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const double x = r.x0 + (r.x1 - r.x0) * (0.5 + k_offset * (i - 1));
      const double y = r.y0 + (r.y1 - r.y0) * (0.5 + k_offset * (j - 1));
      sum += k_weights[static_cast<size_t>(i)] * k_weights[static_cast<size_t>(j)] * f(x, y);
    }
  }
  return sum * r.area();
}

// Splits into quarters until they agree with the whole to `tolerance`, which is shared out as if
// the errors of the parts were independent.
template <class Function>
double integrate_adaptive(const Function& f, const Rectangle& r, double tolerance, int max_depth) {
  const auto quarters = r.quarters();
  double split = 0.0;
  for (const Rectangle& q : quarters)
    split += gauss_3x3(f, q);
  if (max_depth <= 0 || std::abs(split - gauss_3x3(f, r)) <= tolerance) return split;
  double sum = 0.0;
  for (const Rectangle& q : quarters)
    sum += integrate_adaptive(f, q, 0.5 * tolerance, max_depth - 1);
  return sum;
}

}  // namespace tenniel::testing
