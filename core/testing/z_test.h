// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "testing/statistics.h"

// Tests of means for sample sizes (from about 1000) where Student's t is the normal distribution.
// Each gives the probability of a deviation at least as large if nothing is wrong.
namespace tenniel::testing {

// Of the mean of `s` against a known value. `tolerance` is what the value itself may be off by.
inline double z_test(const RunningStatistics& s, double expected, double tolerance = 0.0) {
  const double off = std::max(0.0, std::abs(s.mean() - expected) - tolerance);
  if (off == 0.0) return 1.0;
  const double error = s.standard_error();
  return error > 0.0 ? two_sided_p(off / error) : 0.0;
}

// Of two estimators of the same number (Welch 1947).
inline double welch_test(const RunningStatistics& a, const RunningStatistics& b) {
  const double off = a.mean() - b.mean();
  if (off == 0.0) return 1.0;
  const double error = std::hypot(a.standard_error(), b.standard_error());
  return error > 0.0 ? two_sided_p(off / error) : 0.0;
}

// Of `successes` among `trials` against a known probability: for discrete choices.
inline double binomial_test(int64_t successes, int64_t trials, double probability,
                            double tolerance = 0.0) {
  const auto n = static_cast<double>(trials);
  const double off =
      std::max(0.0, std::abs(static_cast<double>(successes) / n - probability) - tolerance);
  if (off == 0.0) return 1.0;
  const double error = std::sqrt(probability * (1.0 - probability) / n);
  return error > 0.0 ? two_sided_p(off / error) : 0.0;
}

}  // namespace tenniel::testing
