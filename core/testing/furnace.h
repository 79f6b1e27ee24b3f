// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testing/chi2.h"
#include "testing/quadrature.h"

namespace tenniel::testing {

// Integral over all directions of `f` (Vec3 -> number), to about `tolerance`. The square of
// `domain` (SphereDomain, or PeakDomain for what is narrow) is cut into `cells` x 2 `cells` parts
// first.
template <class Function, class Domain = SphereDomain>
double integrate_sphere(const Function& f, double tolerance = 1e-5, int cells = 16,
                        const Domain& domain = {}) {
  const auto on_square = [&](double x, double y) {
    return static_cast<double>(f(domain.from_square(x, y))) * domain.measure(x, y);
  };
  double sum = 0.0;
  for (int j = 0; j < 2 * cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const Rectangle r{static_cast<double>(i) / cells, (i + 1.0) / cells, 0.5 * j / cells,
                        0.5 * (j + 1.0) / cells};
      sum += integrate_adaptive(on_square, r, tolerance / cells, 10);
    }
  }
  return sum;
}

}  // namespace tenniel::testing
