// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "testing/chi2.h"
#include "testing/furnace.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

using testing::chi2_test;
using testing::Chi2Options;
using testing::Chi2Result;

class LobeStatistics : public ::testing::TestWithParam<LobeCase> {
 protected:
  // Of one test among all lobes and angles.
  static double significance() {
    return testing::sidak(0.01, static_cast<int>(exact_cases().size() * std::size(k_angles)));
  }
};

// Where a smooth surface would send the light: the peak of narrow lobes.
Vec3 peak(const Lobe& lobe, Vec3 wo) {
  if (const auto* r = std::get_if<MicrofacetRefraction>(&lobe))
    if (const auto s = SpecularRefraction{r->eta}.sample(wo, {})) return s->wi;
  return {-wo.x, -wo.y, wo.z};
}

TEST_P(LobeStatistics, SamplesFollowTheDensity) {
  const LobeCase& c = GetParam();
  for (const float theta : k_angles) {
    const Vec3 wo = direction(theta, 40.0f);
    const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
      const auto s = sample(c.lobe, wo, u);
      if (!s) return std::nullopt;
      return s->wi;
    };
    const auto pdf = [&](Vec3 wi) { return eval(c.lobe, wo, wi).pdf; };
    Chi2Options options;
    options.samples = 200000;
    options.seed = static_cast<uint32_t>(theta) + 1;
    Chi2Result result;
    if (c.narrowest > 0.2f) {
      result = chi2_test(testing::SphereDomain{}, draw, pdf, options);
    } else {
      const testing::PeakDomain domain{Frame::from_normal(peak(c.lobe, wo))};
      result = chi2_test(domain, draw, pdf, options);
    }
    EXPECT_EQ(result.failure(significance()), "") << "theta " << theta;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LobeStatistics, ::testing::ValuesIn(exact_cases()),
                         [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace tenniel
