// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "testing/furnace.h"
#include "testing/statistics.h"

namespace tenniel {
namespace {

bool is_delta(const Lobe& lobe) {
  return visit_lobe([](const auto& l) { return l.is_delta(); }, lobe);
}

float relative_difference(float a, float b) {
  const float scale = std::max(std::abs(a), std::abs(b));
  return scale > 0.0f ? std::abs(a - b) / scale : 0.0f;
}

float relative_difference(Spectrum a, Spectrum b) {
  return std::max({relative_difference(a.r, b.r), relative_difference(a.g, b.g),
                   relative_difference(a.b, b.b)});
}

class LobeContract : public ::testing::TestWithParam<LobeCase> {};

// A direction is a float: what it is off by, in units of the narrowest feature, moves the value;
// and the half vector of nearly opposite directions has few digits.
float rounding(const LobeCase& c, Vec3 wo, Vec3 wi) {
  return 2e-4f + 2e-5f / c.narrowest + 4e-6f / std::max(1e-3f, length(wo + wi));
}

TEST_P(LobeContract, SampleAgreesWithEval) {
  const LobeCase& c = GetParam();
  if (is_delta(c.lobe)) GTEST_SKIP() << "eval gives zero for a delta";
  LocalRandom random(11);
  double worst = 0.0;
  for (const float theta : k_angles) {
    const Vec3 wo = direction(theta, 40.0f);
    for (int i = 0; i < 2000; ++i) {
      const auto s = sample(c.lobe, wo, random.get_2d());
      if (!s) continue;
      ASSERT_GT(s->pdf, 0.0f);
      ASSERT_NEAR(length(s->wi), 1.0f, 1e-5f);
      const LobeEval e = eval(c.lobe, wo, s->wi);
      // Densities that are tiny beside the peak lie where the value falls by orders of magnitude.
      if (s->pdf < 1e-3f) continue;
      const float off = std::max(relative_difference(s->pdf, e.pdf),
                                 relative_difference(s->weight * s->pdf, e.value));
      worst = std::max(worst, static_cast<double>(off));
      EXPECT_LT(off, rounding(c, wo, s->wi))
          << "theta " << theta << " wi.z " << s->wi.z << " pdf " << s->pdf;
      if (HasFailure()) return;
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST_P(LobeContract, FiniteAndPositiveEverywhere) {
  const LobeCase& c = GetParam();
  LocalRandom random(12);
  for (int i = 0; i < 40000; ++i) {
    Vec3 wo = warp_uniform_hemisphere(random.get_2d()), wi = warp_uniform_sphere(random.get_2d());
    if (i % 4 == 0) wo = direction(90.0f - 1e-3f * random.get_1d(), 360.0f * random.get_1d());
    if (i % 8 < 2) wi = direction(90.0f + 1e-3f * (random.get_1d() - 0.5f), 50.0f);
    if (i % 16 == 3) wi = {-wo.x, -wo.y, wo.z};
    if (i % 16 == 5) wi = -wo;
    if (i % 16 == 7) wi = wo;
    wo.z = std::max(wo.z, 1e-7f);
    const LobeEval e = eval(c.lobe, wo, wi);
    ASSERT_TRUE(is_finite(e.value) && std::isfinite(e.pdf)) << wo.z << " " << wi.z;
    ASSERT_TRUE(e.value.r >= 0.0f && e.value.g >= 0.0f && e.value.b >= 0.0f && e.pdf >= 0.0f);
    // Light that is seen must be found.
    ASSERT_TRUE(e.pdf > 0.0f || is_black(e.value)) << wo.z << " " << wi.z;
    Vec2 u = random.get_2d();
    if (i % 5 == 0) u.x = 0.0f;
    if (i % 5 == 1) u.y = 0.0f;
    if (i % 7 == 0) u.x = k_one_minus_epsilon;
    if (i % 7 == 1) u.y = k_one_minus_epsilon;
    const auto s = sample(c.lobe, wo, u);
    if (!s) continue;
    ASSERT_TRUE(is_finite(s->wi) && is_finite(s->weight) && std::isfinite(s->pdf)) << wo.z;
    ASSERT_GT(s->pdf, 0.0f);
    ASSERT_TRUE(s->weight.r >= 0.0f && s->weight.g >= 0.0f && s->weight.b >= 0.0f);
  }
}

TEST_P(LobeContract, AlbedoIsPositiveWhereTheLobeIs) {
  const LobeCase& c = GetParam();
  LocalRandom random(13);
  for (const float theta : k_angles) {
    const Vec3 wo = direction(theta, 40.0f);
    const Spectrum albedo = visit_lobe([&](const auto& l) { return l.albedo(wo); }, c.lobe);
    bool scatters = false;
    for (int i = 0; i < 100; ++i) {
      const auto s = sample(c.lobe, wo, random.get_2d());
      scatters |= s && !is_black(s->weight);
    }
    EXPECT_TRUE(!scatters || max_component(albedo) > 0.0f) << theta;
    EXPECT_LE(max_component(albedo), 1.0f) << theta;
  }
}

// Each lobe scatters into the half of the sphere that its class says.
TEST_P(LobeContract, StaysOnItsSide) {
  const LobeCase& c = GetParam();
  const LobeClass lobe_class = visit_lobe([](const auto& l) { return l.lobe_class(); }, c.lobe);
  if (std::holds_alternative<HairFiber>(c.lobe)) GTEST_SKIP() << "a hair has no sides";
  const bool passes = lobe_class == LobeClass::transmission || lobe_class == LobeClass::transparent;
  LocalRandom random(14);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 wo = warp_uniform_hemisphere(random.get_2d());
    Vec3 wi = warp_uniform_hemisphere(random.get_2d());
    if (!passes) wi = -wi;
    EXPECT_TRUE(is_black(eval(c.lobe, wo, wi).value));
    const auto s = sample(c.lobe, wo, random.get_2d());
    if (!s) continue;
    EXPECT_EQ(s->wi.z < 0.0f, passes);
  }
}

// Mean weight of samples against the integral of the value, and no more light out than in.
TEST_P(LobeContract, FurnaceHoldsAndAgreesWithSampling) {
  const LobeCase& c = GetParam();
  // Burley's retro-reflection is meant to brighten the rim of rough surfaces.
  const bool may_gain = std::holds_alternative<PrincipledDiffuse>(c.lobe);
  for (const float theta : {0.0f, 15.0f, 30.0f, 45.0f, 60.0f, 75.0f, 85.0f}) {
    const Vec3 wo = direction(theta, 40.0f);
    LocalRandom random(15);
    testing::RunningStatistics weight;
    for (int i = 0; i < 20000; ++i) {
      const auto s = sample(c.lobe, wo, random.get_2d());
      weight.add(s ? static_cast<double>(s->weight.g) : 0.0);
    }
    const double slack = 4.0 * weight.standard_error();
    EXPECT_LE(weight.mean(), (may_gain ? 1.45 : 1.003) + slack) << theta;
    const bool is_exact = !is_delta(c.lobe) && !std::holds_alternative<Clearcoat>(c.lobe);
    if (!is_exact || c.narrowest < 0.09f) continue;
    const double albedo =
        testing::integrate_sphere([&](Vec3 wi) { return eval(c.lobe, wo, wi).value.g; }, 2e-4, 24);
    EXPECT_NEAR(weight.mean(), albedo, slack + 1e-3) << theta;
    EXPECT_LE(albedo, may_gain ? 1.45 : 1.003) << theta;
  }
}

TEST_P(LobeContract, Reciprocal) {
  const LobeCase& c = GetParam();
  if (is_delta(c.lobe)) GTEST_SKIP() << "no density";
  const bool is_drawn =
      std::holds_alternative<DiffuseToon>(c.lobe) || std::holds_alternative<GlossyToon>(c.lobe) ||
      std::holds_alternative<HairLobe>(c.lobe) || std::holds_alternative<HairFiber>(c.lobe);
  if (is_drawn) GTEST_SKIP() << "a model without physics";
  const auto* principled = std::get_if<PrincipledDiffuse>(&c.lobe);
  if (principled && principled->terms == PrincipledDiffuseTerms::lambert_exit)
    GTEST_SKIP() << "half of a way: light came in elsewhere";
  const auto* refraction = std::get_if<MicrofacetRefraction>(&c.lobe);
  Lobe back = c.lobe;
  if (refraction) std::get<MicrofacetRefraction>(back).eta = 1.0f / refraction->eta;
  // Radiance that is not scaled by 1 / eta^2 favours the way into the denser medium.
  const float scale = refraction ? sqr(refraction->eta) : 1.0f;
  LocalRandom random(16);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 wo = warp_uniform_hemisphere(random.get_2d());
    const auto s = sample(c.lobe, wo, random.get_2d());
    if (!s || s->pdf < 1e-3f || abs_cos_theta(s->wi) < 1e-3f) continue;
    const bool passes = s->wi.z < 0.0f;
    const Vec3 from = passes ? -s->wi : s->wi, to = passes ? -wo : wo;
    const Spectrum forth = eval(c.lobe, wo, s->wi).value * wo.z;
    const Spectrum across = eval(back, from, to).value * abs_cos_theta(s->wi) * scale;
    ASSERT_LT(relative_difference(forth, across), 2.0f * rounding(c, wo, s->wi)) << wo.z;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LobeContract, ::testing::ValuesIn(all_cases()),
                         [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace tenniel
