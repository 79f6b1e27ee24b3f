// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace tenniel::testing {

// Mean and unbiased variance of a stream of numbers (Welford 1962).
class RunningStatistics {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    sum_of_squares_ += delta * (x - mean_);
  }
  int64_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const {
    return count_ > 1 ? sum_of_squares_ / static_cast<double>(count_ - 1) : 0.0;
  }
  double standard_error() const {
    return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_)) : 0.0;
  }

 private:
  int64_t count_ = 0;
  double mean_ = 0.0, sum_of_squares_ = 0.0;
};

// Significance of each of `tests` independent tests such that all of them together raise a false
// alarm with probability `significance` (Sidak 1967).
inline double sidak(double significance, int tests) {
  return -std::expm1(std::log1p(-significance) / tests);
}

// Probability that a normal variable lies at least `z` standard deviations off its mean.
inline double two_sided_p(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

// Regularised upper incomplete gamma function Q(a, x) (Abramowitz & Stegun 1964, 6.5.29
// and 6.5.31): a series below the mean, a continued fraction by Lentz's method above it.
inline double gamma_q(double a, double x) {
  if (!(x > 0.0)) return 1.0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  constexpr int k_max_terms = 100000;
  constexpr double k_epsilon = 1e-14;
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < k_max_terms && term > sum * k_epsilon; ++n)
      sum += term *= x / (a + n);
    return 1.0 - front * sum;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, fraction = d;
  for (int n = 1; n < k_max_terms; ++n) {
    const double numerator = -n * (n - a);
    b += 2.0;
    d = 1.0 / (b + numerator * d);
    c = b + numerator / c;
    const double step = c * d;
    fraction *= step;
    if (std::abs(step - 1.0) < k_epsilon) break;
  }
  return front * fraction;
}

// Probability that a chi-squared variable is at least `statistic`.
inline double chi2_p(double statistic, int degrees_of_freedom) {
  return gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

}  // namespace tenniel::testing
