// SPDX-License-Identifier: Apache-2.0
// The tools that judge everything else: they must pass what is right and reject what is wrong.
#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "sampling/warp.h"
#include "testing/chi2.h"
#include "testing/furnace.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

using namespace testing;

const auto k_draw_cosine = [](Vec2 u) { return std::optional<Vec3>(warp_cosine_hemisphere(u)); };

TEST(Chi2Statistics, AcceptsTheRightDensity) {
  const auto pdf = [](Vec3 w) { return cosine_hemisphere_pdf(w.z); };
  EXPECT_EQ(chi2_test(SphereDomain{}, k_draw_cosine, pdf).failure(0.01), "");
  EXPECT_EQ(chi2_test(PeakDomain{}, k_draw_cosine, pdf).failure(0.01), "");
}

// 2 % of the samples in the wrong place.
TEST(Chi2Statistics, RejectsASlightlyWrongShape) {
  const auto pdf = [](Vec3 w) {
    return 0.98f * cosine_hemisphere_pdf(w.z) + 0.02f * (w.z > 0.0f ? uniform_hemisphere_pdf() : 0);
  };
  Chi2Options options;
  options.samples = 1000000;
  options.bins_x = 15;  // few bins see what is wrong everywhere by little
  options.bins_y = 30;
  const Chi2Result result = chi2_test(SphereDomain{}, k_draw_cosine, pdf, options);
  EXPECT_NEAR(result.mass, 1.0, 1e-3);  // so that only the shape gives it away
  EXPECT_NE(result.failure(1e-6), "");
}

TEST(Chi2Statistics, RejectsTheWrongAlpha) {
  const MicrofacetReflection lobe{{MicrofacetDistribution::ggx, 0.3f, 0.3f}, {}};
  const MicrofacetReflection other{{MicrofacetDistribution::ggx, 0.31f, 0.31f}, {}};
  const Vec3 wo = direction(30.0f, 0.0f);
  const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
    const auto s = lobe.sample(wo, u);
    return s ? std::optional(s->wi) : std::nullopt;
  };
  EXPECT_NE(
      chi2_test(SphereDomain{}, draw, [&](Vec3 w) { return other.eval(wo, w).pdf; }).failure(1e-6),
      "");
}

TEST(Chi2Statistics, NoticesMissingMass) {
  // The density is that of what is left: the shape is right, one sample in 50 is lost.
  const auto draw = [](Vec2 u) -> std::optional<Vec3> {
    if (u.x < 0.02f) return std::nullopt;
    return warp_cosine_hemisphere({(u.x - 0.02f) / 0.98f, u.y});
  };
  const auto pdf = [](Vec3 w) { return cosine_hemisphere_pdf(w.z); };
  const Chi2Result result = chi2_test(SphereDomain{}, draw, pdf);
  EXPECT_NEAR(result.sampled_mass, 0.98, 2e-3);
  EXPECT_NE(result.failure(1e-6), "");
  const auto true_pdf = [](Vec3 w) { return 0.98f * cosine_hemisphere_pdf(w.z); };
  EXPECT_EQ(chi2_test(SphereDomain{}, draw, true_pdf).failure(0.01), "");
}

TEST(Chi2Statistics, NoticesADensityAboveOne) {
  const auto pdf = [](Vec3 w) { return 1.01f * cosine_hemisphere_pdf(w.z); };
  EXPECT_NE(chi2_test(SphereDomain{}, k_draw_cosine, pdf).failure(1e-6), "");
}

TEST(Chi2Statistics, PlaneAndLineDomains) {
  const PlaneDomain plane{{-1.0f, -1.0f}, {1.0f, 1.0f}};
  const auto disk = [](Vec2 u) { return std::optional(warp_concentric_disk(u)); };
  const auto disk_pdf = [](Vec2 p) { return dot(p, p) < 1.0f ? concentric_disk_pdf() : 0.0f; };
  EXPECT_EQ(chi2_test(plane, disk, disk_pdf).failure(0.01), "");

  const LineDomain line{0.0f, 3.0f};
  Chi2Options options;
  options.bins_x = 200;
  options.bins_y = 1;
  const auto distance = [](Vec2 u) { return std::optional(-std::log(1.0f - u.x)); };
  const auto right = [](float t) { return std::exp(-t); };
  const auto wrong = [](float t) { return 1.05f * std::exp(-1.05f * t); };
  EXPECT_EQ(chi2_test(line, distance, right, options).failure(0.01), "");
  EXPECT_NE(chi2_test(line, distance, wrong, options).failure(1e-6), "");
}

TEST(StatisticsTools, Chi2Distribution) {
  // Quantiles from tables.
  EXPECT_NEAR(chi2_p(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi2_p(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi2_p(135.806723, 100), 0.01, 1e-6);
  EXPECT_NEAR(chi2_p(67.327563, 100), 0.995, 1e-6);
}

TEST(StatisticsTools, Sidak) {
  EXPECT_NEAR(sidak(0.01, 1), 0.01, 1e-12);
  EXPECT_NEAR(1.0 - std::pow(1.0 - sidak(0.01, 700), 700), 0.01, 1e-9);
}

TEST(StatisticsTools, MeansAreTold) {
  LocalRandom random(3);
  RunningStatistics a, b, shifted;
  for (int i = 0; i < 100000; ++i) {
    a.add(static_cast<double>(random.get_1d()));
    b.add(static_cast<double>(random.get_1d()));
    shifted.add(static_cast<double>(random.get_1d()) + 0.01);
  }
  EXPECT_NEAR(a.variance(), 1.0 / 12.0, 1e-3);
  EXPECT_GT(z_test(a, 0.5), 0.01);
  EXPECT_LT(z_test(a, 0.51), 1e-6);
  EXPECT_GT(z_test(a, 0.51, 0.011), 0.01);
  EXPECT_GT(welch_test(a, b), 0.01);
  EXPECT_LT(welch_test(a, shifted), 1e-6);
  EXPECT_GT(binomial_test(5020, 10000, 0.5), 0.01);
  EXPECT_LT(binomial_test(5300, 10000, 0.5), 1e-6);
}

TEST(StatisticsTools, IntegralsOverTheSphere) {
  EXPECT_NEAR(integrate_sphere([](Vec3) { return 1.0; }), 4.0 * 3.14159265358979, 1e-6);
  const auto cosine = [](Vec3 w) { return std::max(0.0f, w.z); };
  EXPECT_NEAR(integrate_sphere(cosine), 3.14159265358979, 1e-4);
  EXPECT_NEAR(integrate_sphere(cosine, 1e-5, 16, PeakDomain{}), 3.14159265358979, 1e-4);
}

}  // namespace
}  // namespace tenniel
