// SPDX-License-Identifier: Apache-2.0
// Distances along a ray: free flight and equiangular.
#include <gtest/gtest.h>

#include "media/equiangular.h"
#include "media/free_flight.h"
#include "sampling/sampler.h"
#include "testing/chi2.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr Chi2Options k_line{101, 1, 200000, 7, 12};

struct FlightCase {
  const char* name;
  Spectrum sigma_t, sigma_s, throughput;
  float length;
};
const FlightCase k_flights[] = {
    {"grey", Spectrum(2.0f), Spectrum(1.0f), Spectrum(1.0f), 1.5f},
    {"chromatic", {0.3f, 2.0f, 9.0f}, {0.2f, 1.9f, 4.0f}, {1.0f, 0.5f, 0.1f}, 3.0f},
    {"one channel scatters", {5.0f, 1.0f, 0.5f}, {4.0f, 0.0f, 0.0f}, Spectrum(1.0f), 4.0f},
    {"endless", {1.0f, 2.0f, 4.0f}, {1.0f, 1.0f, 1.0f}, Spectrum(1.0f), k_infinity},
    {"thin", Spectrum(1e-5f), Spectrum(1e-5f), Spectrum(1.0f), 1.0f},
};

TEST(FlightStatistics, DistancesFollowTheDensity) {
  for (const FlightCase& c : k_flights) {
    const FreeFlight flight(c.sigma_t, c.sigma_s, c.throughput, c.length);
    const LineDomain line{0.0f, std::min(c.length, 12.0f)};
    const auto draw = [&](Vec2 u) -> std::optional<float> { return flight.sample(u.x); };
    const auto pdf = [&](float t) { return flight.pdf(t); };
    EXPECT_EQ(chi2_test(line, draw, pdf, k_line).failure(sidak(0.01, std::size(k_flights))), "")
        << c.name;
  }
}

// Both events leave the channels' sum of throughput as it was, less what is absorbed: no noise.
TEST(FreeFlight, EitherEventLeavesTheSameSum) {
  LocalRandom random(3);
  for (const FlightCase& c : k_flights) {
    const FreeFlight flight(c.sigma_t, c.sigma_s, c.throughput, c.length);
    const Spectrum through = flight.transmittance();
    const auto left = [](float sigma_t, float sigma_s, float passed) {
      return passed + sigma_s / sigma_t * (1.0f - passed);
    };
    const Spectrum kept = c.throughput * Spectrum(left(c.sigma_t.r, c.sigma_s.r, through.r),
                                                  left(c.sigma_t.g, c.sigma_s.g, through.g),
                                                  left(c.sigma_t.b, c.sigma_s.b, through.b));
    const float p = flight.scatter_probability();
    if (p < 1.0f) {
      EXPECT_NEAR(mean(c.throughput * through) / (1.0f - p) / mean(kept), 1.0f, 1e-4f) << c.name;
    }
    for (int i = 0; i < 100; ++i) {
      const float t = flight.sample(random.get_1d());
      const Spectrum scattered =
          c.throughput * c.sigma_s * beer_lambert(c.sigma_t, t) / (flight.pdf(t) * p);
      EXPECT_NEAR(mean(scattered) / mean(kept), 1.0f, 2e-3f) << c.name << " at " << t;
    }
  }
}

TEST(FreeFlight, MeanFreePathAndEscape) {
  const FreeFlight endless(Spectrum(0.5f), Spectrum(0.5f), Spectrum(1.0f), k_infinity);
  EXPECT_FLOAT_EQ(endless.scatter_probability(), 1.0f);
  RunningStatistics distances;
  LocalRandom random(5);
  for (int i = 0; i < 100000; ++i)
    distances.add(static_cast<double>(endless.sample(random.get_1d())));
  EXPECT_GT(z_test(distances, 2.0), 1e-3);
  const FreeFlight slab(Spectrum(0.5f), Spectrum(0.5f), Spectrum(1.0f), 3.0f);
  EXPECT_NEAR(slab.scatter_probability(), 1.0f - std::exp(-1.5f), 1e-6f);
  const FreeFlight absorbing(Spectrum(0.5f), Spectrum(), Spectrum(1.0f), 3.0f);
  EXPECT_EQ(absorbing.scatter_probability(), 0.0f);
  EXPECT_NEAR(absorbing.transmittance().g, std::exp(-1.5f), 1e-6f);
}

TEST(FreeFlight, EmissionLengthIsTheIntegralOfTheTransmittance) {
  EXPECT_EQ(emission_length(0.0f, 3.0f), 3.0f);
  EXPECT_EQ(emission_length(0.0f, k_infinity), 0.0f);
  EXPECT_FLOAT_EQ(emission_length(0.5f, k_infinity), 2.0f);
  EXPECT_NEAR(emission_length(0.5f, 3.0f), 2.0f * (1.0f - std::exp(-1.5f)), 1e-6f);
  EXPECT_NEAR(emission_length(1e-9f, 3.0f), 3.0f, 1e-6f);
}

struct RayCase {
  const char* name;
  Vec3 center;
  float length;
};
const RayCase k_rays[] = {
    {"beside", {1.0f, 0.5f, 0.0f}, 3.0f}, {"behind", {-2.0f, 0.3f, 0.1f}, 3.0f},
    {"beyond", {6.0f, 1.0f, 0.0f}, 3.0f}, {"endless", {2.0f, 0.7f, 0.0f}, k_infinity},
    {"close", {1.0f, 0.02f, 0.0f}, 3.0f},
};

TEST(EquiangularStatistics, DistancesFollowTheDensity) {
  const Ray ray{{}, {1.0f, 0.0f, 0.0f}};
  for (const RayCase& c : k_rays) {
    const Equiangular equiangular(ray, c.length, c.center);
    ASSERT_TRUE(equiangular.is_usable());
    const LineDomain line{0.0f, std::min(c.length, 20.0f)};
    const auto draw = [&](Vec2 u) -> std::optional<float> { return equiangular.sample(u.x); };
    const auto pdf = [&](float t) { return equiangular.pdf(t); };
    EXPECT_EQ(chi2_test(line, draw, pdf, k_line).failure(sidak(0.01, std::size(k_rays))), "")
        << c.name;
  }
}

TEST(Equiangular, IsFiniteWhereTheRayMeetsTheCenter) {
  const Ray ray{{}, {1.0f, 0.0f, 0.0f}};
  for (const Vec3 center : {Vec3{}, Vec3{1.0f, 0.0f, 0.0f}, Vec3{-1.0f, 0.0f, 0.0f}}) {
    for (const float length : {2.0f, k_infinity}) {
      const Equiangular equiangular(ray, length, center);
      if (!equiangular.is_usable()) continue;
      for (const float u : {0.0f, 0.5f, k_one_minus_epsilon}) {
        const float t = equiangular.sample(u);
        EXPECT_TRUE(std::isfinite(t) && t >= 0.0f && t <= length);
        EXPECT_TRUE(std::isfinite(equiangular.pdf(t)));
      }
    }
  }
}

}  // namespace
}  // namespace tenniel
