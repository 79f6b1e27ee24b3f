// SPDX-License-Identifier: Apache-2.0
#include "bsdf/multi_ggx.h"

#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "testing/statistics.h"

namespace tenniel {
namespace {

// Where sampled light goes: how much, and its mean height.
struct Flow {
  testing::RunningStatistics amount, height;
};

template <class L>
Flow sampled(L lobe, Vec3 wo, int count) {
  LocalRandom random(3);
  Flow flow;
  for (int i = 0; i < count; ++i) {
    lobe.surface.seed = random.next();
    const auto s = lobe.sample(wo, random.get_2d());
    flow.amount.add(s ? static_cast<double>(s->weight.g) : 0.0);
    flow.height.add(s ? static_cast<double>(s->weight.g * s->wi.z) : 0.0);
  }
  return flow;
}

template <class L>
Flow evaluated(L lobe, Vec3 wo, int count) {
  LocalRandom random(4);
  Flow flow;
  for (int i = 0; i < count; ++i) {
    lobe.surface.seed = random.next();
    const Vec3 wi = warp_uniform_sphere(random.get_2d());
    const double value = lobe.eval(wo, wi).value.g / uniform_sphere_pdf();
    flow.amount.add(value);
    flow.height.add(value * wi.z);
  }
  return flow;
}

constexpr float k_alphas[][2] = {{0.3f, 0.3f}, {1.0f, 1.0f}, {0.6f, 0.15f}};

TEST(MultiGgx, ReflectsAllOfTheLight) {
  for (const auto& a : k_alphas)
    for (const float theta : {0.0f, 45.0f, 80.0f}) {
      const Flow flow = sampled(MultiGgxReflection{{a[0], a[1]}}, direction(theta, 40.0f), 20000);
      EXPECT_NEAR(flow.amount.mean(), 1.0, 0.004) << a[0] << " " << theta;
    }
}

TEST(MultiGgx, GlassKeepsAllOfTheLight) {
  for (const float eta : {1.5f, 1.0f / 1.5f})
    for (const float theta : {0.0f, 45.0f, 75.0f}) {
      MultiScatter scatter{0.6f, 0.6f, eta};
      const Vec3 wo = direction(theta, 40.0f);
      const double sum = sampled(MultiGgxReflection{scatter}, wo, 60000).amount.mean() +
                         sampled(MultiGgxTransmission{scatter}, wo, 60000).amount.mean();
      EXPECT_NEAR(sum, 1.0, 0.012) << eta << " " << theta;
    }
}

// Both ways to the same integral: of the value, and of the samples.
TEST(MultiGgx, EvaluationAgreesWithSampling) {
  const auto agree = [](const Flow& a, const Flow& b, const char* what, float theta) {
    EXPECT_NEAR(a.amount.mean(), b.amount.mean(),
                0.012 + 4.0 * (a.amount.standard_error() + b.amount.standard_error()))
        << what << theta;
    EXPECT_NEAR(a.height.mean(), b.height.mean(),
                0.012 + 4.0 * (a.height.standard_error() + b.height.standard_error()))
        << what << theta;
  };
  for (const float theta : {10.0f, 60.0f}) {
    const Vec3 wo = direction(theta, 40.0f);
    for (const auto& a : k_alphas) {
      const MultiGgxReflection lobe{{a[0], a[1]}};
      agree(sampled(lobe, wo, 60000), evaluated(lobe, wo, 300000), "reflection ", theta);
    }
    const MultiScatter glass{0.7f, 0.7f, 1.5f};
    agree(sampled(MultiGgxReflection{glass}, wo, 60000),
          evaluated(MultiGgxReflection{glass}, wo, 300000), "glass reflection ", theta);
    agree(sampled(MultiGgxTransmission{glass}, wo, 60000),
          evaluated(MultiGgxTransmission{glass}, wo, 300000), "glass transmission ", theta);
  }
}

TEST(MultiGgx, IsFiniteAndPositiveEverywhere) {
  LocalRandom random(5);
  for (int i = 0; i < 20000; ++i) {
    const float alpha = random.get_1d(), eta = 0.3f + 3.0f * random.get_1d();
    MultiScatter scatter{alpha, random.get_1d(), eta};
    scatter.seed = random.next();
    MultiGgxReflection reflection{scatter};
    MultiGgxTransmission transmission{scatter};
    ASSERT_TRUE(reflection.make_valid() && transmission.make_valid());
    Vec3 wo = warp_uniform_hemisphere(random.get_2d());
    wo.z = std::max(wo.z, 1e-7f);
    const Vec3 wi = warp_uniform_sphere(random.get_2d());
    const auto is_good = [](const LobeEval& e) {
      return is_finite(e.value) && e.value.r >= 0.0f && e.pdf >= 0.0f && std::isfinite(e.pdf) &&
             (e.pdf > 0.0f || is_black(e.value));
    };
    ASSERT_TRUE(is_good(reflection.eval(wo, wi)) && is_good(transmission.eval(wo, wi)));
    for (const auto& s :
         {reflection.sample(wo, random.get_2d()), transmission.sample(wo, random.get_2d())})
      ASSERT_TRUE(!s || (is_finite(s->wi) && is_finite(s->weight) && s->pdf > 0.0f));
  }
}

}  // namespace
}  // namespace tenniel
