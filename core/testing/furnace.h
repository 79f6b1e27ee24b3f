// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/vec.h"
#include "testing/chi2.h"
#include "testing/quadrature.h"

namespace tenniel::testing {

// Integral over all directions of `f` (Vec3 -> number), to about `tolerance`. The sphere is cut
// into `rings` x 2 `rings` patches first; narrow peaks need more of them.
template <class Function>
double integrate_sphere(const Function& f, double tolerance = 1e-5, int rings = 16) {
  const auto on_square = [&](double x, double y) {
    return static_cast<double>(f(SphereDomain::from_square(x, y)));
  };
  double sum = 0.0;
  for (int j = 0; j < 2 * rings; ++j) {
    for (int i = 0; i < rings; ++i) {
      const Rectangle r{static_cast<double>(i) / rings, (i + 1.0) / rings, 0.5 * j / rings,
                        0.5 * (j + 1.0) / rings};
      sum += integrate_adaptive(on_square, r, tolerance / (SphereDomain::total * rings), 10);
    }
  }
  return sum * SphereDomain::total;
}

}  // namespace tenniel::testing
