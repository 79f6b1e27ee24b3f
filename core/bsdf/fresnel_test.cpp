// SPDX-License-Identifier: Apache-2.0
#include "bsdf/fresnel.h"

#include <gtest/gtest.h>

namespace tenniel {
namespace {

// 2 * integral of mu F(mu) by the midpoint rule.
template <class Reflectance>
double hemispherical_average(const Reflectance& f) {
  constexpr int k_steps = 200000;
  double sum = 0.0;
  for (int i = 0; i < k_steps; ++i) {
    const double mu = (i + 0.5) / k_steps;
    sum += 2.0 * mu * static_cast<double>(f(static_cast<float>(mu)));
  }
  return sum / k_steps;
}

TEST(FresnelDielectric, NormalIncidence) {
  for (const float eta : {1.0f, 1.1f, 1.45f, 1.5f, 2.4f, 1.0f / 1.5f})
    EXPECT_NEAR(fresnel_dielectric(1.0f, eta), sqr((eta - 1.0f) / (eta + 1.0f)), 1e-7f) << eta;
}

TEST(FresnelDielectric, GrazingReflectsAll) {
  for (const float eta : {1.1f, 1.5f, 0.7f})
    EXPECT_FLOAT_EQ(fresnel_dielectric(0.0f, eta), 1.0f);
}

TEST(FresnelDielectric, TotalInternalReflectionBeginsAtTheCriticalAngle) {
  const float eta = 1.0f / 1.5f;
  const float critical = std::sqrt(1.0f - sqr(eta));  // its cosine
  EXPECT_EQ(fresnel_dielectric(critical - 1e-3f, eta), 1.0f);
  EXPECT_LT(fresnel_dielectric(critical + 1e-3f, eta), 0.9f);
}

// At Brewster's angle, tan = eta, only the perpendicular part is left: half of sin^2(i - t).
TEST(FresnelDielectric, BrewsterAngle) {
  const float eta = 1.5f;
  const float theta_i = std::atan(eta), theta_t = 0.5f * k_pi - theta_i;
  EXPECT_NEAR(fresnel_dielectric(std::cos(theta_i), eta), 0.5f * sqr(std::sin(theta_i - theta_t)),
              1e-6f);
}

TEST(FresnelDielectric, HemisphericalAverages) {
  // Quadrature in double precision.
  constexpr struct {
    float eta;
    double average;
  } k_averages[] = {{1.33f, 0.065931},        {1.45f, 0.084367},        {1.5f, 0.091778},
                    {1.0f / 1.33f, 0.471949}, {1.0f / 1.45f, 0.564503}, {1.0f / 1.5f, 0.596346}};
  for (const auto& [eta, average] : k_averages) {
    const float n = eta;
    EXPECT_NEAR(hemispherical_average([n](float c) { return fresnel_dielectric(c, n); }), average,
                2e-6)
        << eta;
  }
}

TEST(FresnelConductor, NormalIncidence) {
  for (const float eta : {0.14f, 0.9f, 1.5f, 3.0f})
    for (const float k : {0.0f, 0.5f, 2.4f, 7.0f})
      EXPECT_NEAR(fresnel_conductor(1.0f, eta, k),
                  (sqr(eta - 1.0f) + sqr(k)) / (sqr(eta + 1.0f) + sqr(k)), 1e-6f)
          << eta << " " << k;
}

TEST(FresnelConductor, WithoutAbsorptionIsTheDielectric) {
  for (const float eta : {1.0f, 1.2f, 1.5f, 2.4f, 0.6f}) {
    for (int i = 0; i <= 100; ++i) {
      const float c = static_cast<float>(i) / 100.0f;
      // Next to the critical angle the curve is vertical.
      if (eta < 1.0f && std::abs(sqr(c) - (1.0f - sqr(eta))) < 1e-3f) continue;
      if (eta == 1.0f && c == 0.0f) continue;  // 0 / 0: both answers are right
      EXPECT_NEAR(fresnel_conductor(c, eta, 0.0f), fresnel_dielectric(c, eta), 2e-6f)
          << eta << " " << c;
    }
  }
}

TEST(FresnelConductor, GrazingReflectsAll) {
  EXPECT_NEAR(fresnel_conductor(0.0f, 0.4f, 2.4f), 1.0f, 1e-6f);
}

// Normal reflectance of metals from the RGB indices of Mitsuba 3 (its *_rgb variants), worked out
// in double precision.
TEST(FresnelConductor, Metals) {
  const Fresnel au =
      Fresnel::conductor({0.14304f, 0.37531f, 1.44205f}, {3.983f, 2.38556f, 1.60336f});
  EXPECT_NEAR(au(1.0f).r, 0.96668f, 1e-5f);
  EXPECT_NEAR(au(1.0f).g, 0.80201f, 1e-5f);
  EXPECT_NEAR(au(1.0f).b, 0.32412f, 1e-5f);
  const Fresnel al =
      Fresnel::conductor({1.6575f, 0.88041f, 0.52124f}, {9.22382f, 6.26951f, 4.83701f});
  EXPECT_NEAR(al(1.0f).r, 0.92805f, 1e-5f);
  EXPECT_NEAR(al(1.0f).g, 0.9178f, 1e-5f);
  EXPECT_NEAR(al(1.0f).b, 0.91891f, 1e-5f);
}

// Indices fitted to the spectral reflectance of copper under D65 at 0 and at acos(1/7): both angles
// must come out, so the shape of the curve is right as well.
TEST(FresnelConductor, CopperFacingAndNearGrazing) {
  const Fresnel cu = Fresnel::conductor({0.147f, 0.9756f, 1.2086f}, {3.43219f, 2.62063f, 2.36419f});
  const Spectrum facing = cu(1.0f), tilted = cu(1.0f / 7.0f);
  EXPECT_NEAR(facing.r, 0.9551f, 2e-5f);
  EXPECT_NEAR(facing.g, 0.63768f, 2e-5f);
  EXPECT_NEAR(facing.b, 0.53814f, 2e-5f);
  EXPECT_NEAR(tilted.r, 0.96254f, 3e-5f);
  EXPECT_NEAR(tilted.g, 0.76694f, 3e-5f);
  EXPECT_NEAR(tilted.b, 0.71623f, 3e-5f);
}

TEST(FresnelPrincipled, RunsFromTheColourToWhite) {
  const Spectrum cspec0{0.02f, 0.3f, 0.8f};
  const Fresnel f = Fresnel::principled(cspec0, 1.45f);
  EXPECT_NEAR(f(1.0f).g, 0.3f, 1e-6f);
  EXPECT_NEAR(f(0.0f).r, 1.0f, 1e-6f);
  const float f0 = fresnel_dielectric(1.0f, 1.45f);
  const float t = (fresnel_dielectric(0.3f, 1.45f) - f0) / (1.0f - f0);
  EXPECT_NEAR(f(0.3f).b, lerp(0.8f, 1.0f, t), 1e-6f);
}

TEST(FresnelPrincipled, ExtremeIndicesStayFinite) {
  for (const float ior : {0.0f, 1e-3f, 1.0f, 1e6f})
    for (const float c : {0.0f, 0.5f, 1.0f}) {
      const Spectrum s = Fresnel::principled(Spectrum(0.5f), ior)(c);
      EXPECT_TRUE(is_finite(s) && s.r >= 0.5f && s.r <= 1.0f) << ior << " " << c;
    }
}

TEST(Refract, ObeysSnellAndStaysInThePlane) {
  const Vec3 m = normalize({0.2f, -0.1f, 1.0f});
  for (const float eta : {1.5f, 1.0f / 1.5f, 1.0f, 2.4f}) {
    const Vec3 wo = normalize({0.3f, 0.4f, 1.2f});
    const auto wi = refract(wo, m, eta);
    ASSERT_TRUE(wi);
    EXPECT_NEAR(length(*wi), 1.0f, 1e-6f);
    EXPECT_NEAR(length(cross(wo, m)), eta * length(cross(*wi, m)), 1e-6f);
    EXPECT_NEAR(dot(cross(wo, m), *wi), 0.0f, 1e-6f);
    EXPECT_LT(dot(*wi, m), 0.0f);
  }
}

TEST(Refract, EmptyAtTotalInternalReflection) {
  EXPECT_FALSE(refract(normalize({1.0f, 0.0f, 0.5f}), {0.0f, 0.0f, 1.0f}, 1.0f / 1.5f));
}

}  // namespace
}  // namespace tenniel
