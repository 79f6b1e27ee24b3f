// SPDX-License-Identifier: Apache-2.0
#include "bsdf/clearcoat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/lobe_cases.h"
#include "bsdf/microfacet_reflection.h"
#include "sampling/sampler.h"
#include "testing/chi2.h"

namespace tenniel {
namespace {

constexpr float k_alphas[] = {0.01f, 0.1f, 0.5f, 0.9999f, 1.0f};

// Smith's masking of a GGX surface with alpha 0.25.
double masking(Vec3 w) {
  const double z = w.z, tan2 = (1.0 - z * z) / (z * z);
  return 2.0 / (1.0 + std::sqrt(1.0 + 0.0625 * tan2));
}

// What glass of index 1.5 reflects.
double fresnel(double cos_facet) {
  const double g = std::sqrt(1.25 + cos_facet * cos_facet);
  const double a = (g - cos_facet) / (g + cos_facet);
  const double b = (cos_facet * (g + cos_facet) - 1.0) / (cos_facet * (g - cos_facet) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// Burley 2012, eq. 4.
double gtr1(float alpha, double cos_m) {
  const double a2 = double{alpha} * double{alpha};
  const double scale = alpha < 1.0f ? (a2 - 1.0) / std::log(a2) : 1.0;
  return scale / (3.14159265358979 * (1.0 + (a2 - 1.0) * cos_m * cos_m));
}

TEST(Clearcoat, EvaluatesFacetsOfGtr1) {
  LocalRandom random(5);
  for (const float alpha : k_alphas) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 wo = direction(85.0f * random.get_1d(), 360.0f * random.get_1d());
      const Vec3 wi = direction(85.0f * random.get_1d(), 360.0f * random.get_1d());
      const Vec3 half = normalize(wo + wi);
      const double pdf = masking(wo) * gtr1(alpha, half.z) / (4.0 * wo.z);
      const LobeEval e = Clearcoat{alpha}.eval(wo, wi);
      EXPECT_NEAR(e.pdf / pdf, 1.0, 2e-3) << alpha;
      EXPECT_NEAR(e.value.g / (pdf * masking(wi) * fresnel(dot(wo, half))), 1.0, 2e-3) << alpha;
    }
  }
}

TEST(Clearcoat, SamplesWeighFresnelAndMasking) {
  LocalRandom random(6);
  for (const float alpha : k_alphas) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 wo = direction(85.0f * random.get_1d(), 0.0f);
      const auto s = sample(Clearcoat{alpha}, wo, random.get_2d());
      if (!s) continue;
      const double cos_facet = dot(wo, normalize(wo + s->wi));
      EXPECT_NEAR(s->weight.g, masking(s->wi) * fresnel(cos_facet), 2e-5) << alpha;
    }
  }
}

TEST(ClearcoatStatistics, SamplesAreReflectionsInGgxFacets) {
  for (const float alpha : {0.1f, 0.3f, 0.6f, 1.0f}) {
    const MicrofacetReflection ggx{{MicrofacetDistribution::ggx, alpha, alpha}, Fresnel::none()};
    for (const float theta : {5.0f, 45.0f, 75.0f}) {
      const Vec3 wo = direction(theta, 40.0f);
      const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
        const auto s = sample(Clearcoat{alpha}, wo, u);
        return s ? std::optional(s->wi) : std::nullopt;
      };
      const auto pdf = [&](Vec3 wi) { return ggx.eval(wo, wi).pdf; };
      const testing::PeakDomain domain{Frame::from_normal({-wo.x, -wo.y, wo.z})};
      EXPECT_EQ(testing::chi2_test(domain, draw, pdf).failure(testing::sidak(0.01, 12)), "")
          << alpha << " " << theta;
    }
  }
}

}  // namespace
}  // namespace tenniel
