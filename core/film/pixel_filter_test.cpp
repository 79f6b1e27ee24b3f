// SPDX-License-Identifier: Apache-2.0
#include "film/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace tenniel {
namespace {

using Kind = PixelFilter::Kind;

// u at which the filter reaches `x`, from its closed-form integral.
double gaussian_cdf(double x, double width) {
  return 0.5 * (1.0 + std::erf(x * 4.0 / width / std::sqrt(2.0)));
}
double blackman_harris_cdf(double x, double width) {
  const double pi = std::acos(-1.0), t = pi * x / width;  // cos(t + pi) = -cos(t)
  return 0.5 + (0.35875 * t + 0.48829 * std::sin(t) + 0.14128 * std::sin(2.0 * t) / 2.0 +
                0.01168 * std::sin(3.0 * t) / 3.0) /
                   (2.0 * pi * 0.35875);
}

void expect_inverse(const PixelFilter& filter, const std::function<double(double)>& cdf) {
  for (int i = 0; i < 5000; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 5000.0f;
    const Vec2 offset = filter.sample({u, 1.0f - u});
    EXPECT_NEAR(cdf(offset.x), u, 2e-6);
    EXPECT_NEAR(cdf(offset.y), 1.0f - u, 2e-6);
  }
}

TEST(PixelFilter, BoxCoversThePixelEvenly) {
  for (const float width : {0.5f, 1.0f, 3.0f}) {
    const PixelFilter box(Kind::box, width);
    expect_inverse(box, [](double x) { return x + 0.5; });
    EXPECT_FLOAT_EQ(box.radius(), 0.5f);
  }
}

TEST(PixelFilter, GaussianInvertsItsIntegral) {
  for (const float width : {0.7f, 1.5f, 4.0f})
    expect_inverse(PixelFilter(Kind::gaussian, width),
                   [width](double x) { return gaussian_cdf(x, width); });
}

TEST(PixelFilter, BlackmanHarrisInvertsItsIntegral) {
  for (const float width : {0.7f, 1.5f, 4.0f})
    expect_inverse(PixelFilter(Kind::blackman_harris, width),
                   [width](double x) { return blackman_harris_cdf(x, width); });
}

double variance(const PixelFilter& filter) {
  constexpr int k_count = 200000;
  double sum = 0.0;
  for (int i = 0; i < k_count; ++i) {
    const double x = filter.sample({(static_cast<float>(i) + 0.5f) / k_count, 0.5f}).x;
    sum += x * x / k_count;
  }
  return sum;
}

TEST(PixelFilter, HasTheVarianceOfItsKernel) {
  EXPECT_NEAR(variance(PixelFilter(Kind::box, 1.0f)), 1.0 / 12.0, 1e-5);
  EXPECT_NEAR(variance(PixelFilter(Kind::gaussian, 2.0f)), 0.25, 1e-4);  // sigma = width / 4
  // Integral of x^2 (sum of a_k cos(k pi x / w)) over +-w: w^2 (1/3 + 2 sum a_k (-1)^k / (k pi)^2).
  const double pi2 = std::acos(-1.0) * std::acos(-1.0);
  const double series = (-0.48829 + 0.14128 / 4.0 - 0.01168 / 9.0) / 0.35875;
  EXPECT_NEAR(variance(PixelFilter(Kind::blackman_harris, 1.5f)),
              2.25 * (1.0 / 3.0 + 2.0 * series / pi2), 1e-4);
}

TEST(PixelFilter, StaysWithinItsRadius) {
  for (const Kind kind : {Kind::box, Kind::gaussian, Kind::blackman_harris}) {
    for (const float width : {1.5f, 0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
      const PixelFilter filter(kind, width);
      EXPECT_GT(filter.radius(), 0.0f);
      for (const float u : {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f}) {
        const Vec2 offset = filter.sample({u, u});
        EXPECT_LE(std::abs(offset.x), filter.radius());
        EXPECT_TRUE(std::isfinite(offset.x));
      }
      EXPECT_NEAR(filter.sample({0.5f, 0.5f}).x, 0.0f, 1e-6f);
      EXPECT_FLOAT_EQ(filter.sample({0.0f, 0.5f}).x, -filter.radius());
    }
  }
}

}  // namespace
}  // namespace tenniel
