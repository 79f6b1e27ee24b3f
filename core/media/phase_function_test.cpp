// SPDX-License-Identifier: Apache-2.0
#include "media/phase_function.h"

#include <gtest/gtest.h>

#include "testing/chi2.h"
#include "testing/furnace.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

using namespace testing;

const Vec3 k_direction = normalize(Vec3{0.3f, -0.5f, 0.7f});
constexpr float k_anisotropies[] = {-0.95f, -0.5f, -1e-4f, 0.0f, 2e-3f, 0.4f, 0.9f, 0.99f};

PhaseFunction three_lobes() {
  PhaseFunction phase;
  phase.add({0.5f, 0.2f, 0.1f}, 0.8f);
  phase.add({0.1f, 0.6f, 0.3f}, -0.4f);
  phase.add(Spectrum(0.2f), 0.0f);
  return phase;
}

TEST(HenyeyGreenstein, IntegratesToOneWithMeanCosineG) {
  for (const float g : k_anisotropies) {
    const PeakDomain domain{Frame::from_normal(g < 0.0f ? -k_direction : k_direction)};
    const auto value = [&](Vec3 wi) { return henyey_greenstein(k_direction, wi, g); };
    EXPECT_NEAR(integrate_sphere(value, 1e-6, 32, domain), 1.0, 1e-4) << g;
    const auto cosine = [&](Vec3 wi) { return value(wi) * dot(wi, k_direction); };
    EXPECT_NEAR(integrate_sphere(cosine, 1e-6, 32, domain), std::abs(g) < 1e-3f ? 0.0f : g, 1e-3)
        << g;
  }
}

TEST(HenyeyGreenstein, AgreesWithItsFormula) {
  const Vec3 z{0.0f, 0.0f, 1.0f};
  for (const float g : {-0.5f, 0.3f, 0.9f}) {
    for (const float c : {-1.0f, -0.2f, 0.5f, 1.0f}) {
      const Vec3 wi{std::sqrt(1.0f - c * c), 0.0f, c};
      const double d = 1.0 + g * g - 2.0 * g * c;
      EXPECT_NEAR(henyey_greenstein(z, wi, g) / ((1.0 - g * g) / (4.0 * M_PI * d * std::sqrt(d))),
                  1.0, 1e-5);
    }
  }
}

TEST(PhaseStatistics, SamplesFollowTheDensity) {
  const int tests = static_cast<int>(std::size(k_anisotropies)) + 1;
  for (const float g : k_anisotropies) {
    const PeakDomain domain{Frame::from_normal(g < 0.0f ? -k_direction : k_direction)};
    const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
      return sample_henyey_greenstein(k_direction, g, u);
    };
    const auto pdf = [&](Vec3 wi) { return henyey_greenstein(k_direction, wi, g); };
    EXPECT_EQ(chi2_test(domain, draw, pdf).failure(sidak(0.01, tests)), "") << g;
  }
  const PhaseFunction phase = three_lobes();
  const auto draw = [&](float u_lobe, Vec2 u) -> std::optional<Vec3> {
    return phase.sample(k_direction, u_lobe, u).wi;
  };
  const auto pdf = [&](Vec3 wi) { return phase.eval(k_direction, wi).pdf; };
  EXPECT_EQ(
      chi2_test(PeakDomain{Frame::from_normal(k_direction)}, draw, pdf).failure(sidak(0.01, tests)),
      "");
}

TEST(PhaseFunction, ValueIntegratesToTheScatteringCoefficient) {
  const PhaseFunction phase = three_lobes();
  const auto red = [&](Vec3 wi) { return phase.eval(k_direction, wi).value.r; };
  const auto green = [&](Vec3 wi) { return phase.eval(k_direction, wi).value.g; };
  EXPECT_NEAR(integrate_sphere(red), 0.8, 1e-4);
  EXPECT_NEAR(integrate_sphere(green), 1.0, 1e-4);
}

TEST(PhaseFunction, SurplusLobesKeepWeightAndMeanCosine) {
  PhaseFunction phase;
  double moment = 0.0;
  for (int i = 0; i < 20; ++i) {
    const float g = -0.7f + 0.07f * static_cast<float>(i);
    phase.add(Spectrum(0.1f), g);
    moment += 0.1 * g;
  }
  const auto value = [&](Vec3 wi) { return phase.eval(k_direction, wi).value.r; };
  const auto cosine = [&](Vec3 wi) { return value(wi) * dot(wi, k_direction); };
  EXPECT_NEAR(integrate_sphere(value), 2.0, 1e-3);
  EXPECT_NEAR(integrate_sphere(cosine), moment, 1e-3);
}

}  // namespace
}  // namespace tenniel
