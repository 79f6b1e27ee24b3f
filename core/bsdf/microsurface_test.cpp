// SPDX-License-Identifier: Apache-2.0
#include "bsdf/microsurface.h"

#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "testing/furnace.h"

namespace tenniel {
namespace {

using testing::integrate_sphere;

constexpr auto k_ggx = MicrofacetDistribution::ggx;
constexpr auto k_beckmann = MicrofacetDistribution::beckmann;

std::vector<Microsurface> surfaces() {
  std::vector<Microsurface> list;
  for (const auto d : {k_ggx, k_beckmann})
    for (const auto& [x, y] : {std::pair{0.1f, 0.1f}, {0.4f, 0.4f}, {1.0f, 1.0f}, {0.15f, 0.7f}})
      list.push_back({d, x, y});
  return list;
}

// The facets cover the plane once.
TEST(Microsurface, NormalDensityProjectsToOne) {
  for (const Microsurface& s : surfaces())
    EXPECT_NEAR(integrate_sphere([&](Vec3 m) { return s.normal_density(m) * m.z; }), 1.0, 1e-4)
        << s.alpha_x << " " << s.alpha_y;
}

// What is seen of the facets covers the view: the integral of D(m) max(0, w.m) is the visible area
// (Heitz 2014, eqs. 13 and 14).
TEST(Microsurface, SmithIdentity) {
  for (const Microsurface& s : surfaces()) {
    for (const float theta : {0.0f, 30.0f, 60.0f, 80.0f, 89.0f}) {
      const Vec3 w = direction(theta, 25.0f);
      const double seen = integrate_sphere(
          [&](Vec3 m) {
            return s.normal_density(m) * std::max(0.0f, dot(w, m)) / s.visible_area(w);
          },
          1e-4, 32, testing::PeakDomain{});
      EXPECT_NEAR(seen, 1.0, 1e-3) << s.alpha_x << " theta " << theta;
    }
  }
}

// Walter's fit, against G1 = cos / visible area.
TEST(Microsurface, BeckmannMaskingFit) {
  const Microsurface s{k_beckmann, 0.81f, 0.81f};
  double largest = 0.0;
  for (float theta = 0.0f; theta < 89.9f; theta += 0.5f) {
    const Vec3 w = direction(theta, 25.0f);
    const double off = s.masking(w) / (w.z / s.visible_area(w)) - 1.0;
    largest = std::max(largest, std::abs(off));
  }
  EXPECT_LT(largest, 0.0033);
  EXPECT_GT(largest, 0.0025);  // it is the fit
  EXPECT_EQ(s.masking({0, 0, 1}), 1.0f);
  // a = 1 / (alpha tan 45) = 1.2346: (3.535 a + 2.181 a^2) / (1 + 2.276 a + 2.577 a^2).
  EXPECT_NEAR(s.masking(direction(45.0f, 25.0f)), 0.99364, 1e-4);
}

// Value over pdf carries both maskings of either distribution.
TEST(Microsurface, MaskingOfVisibleFacets) {
  for (const Microsurface& s : surfaces()) {
    const Vec3 wo = direction(60.0f, 10.0f), wi = direction(50.0f, 200.0f);
    const float area = s.visible_area(wo);
    const float pdf_to_density = wo.z / area;  // G1(wo) of the pdf
    EXPECT_NEAR(s.masking_of_visible(wo, area, wi) * pdf_to_density, s.masking(wo) * s.masking(wi),
                1e-6f);
  }
}

TEST(Microsurface, InverseErrorFunction) {
  for (float x = -0.999f; x < 1.0f; x += 0.01f)
    EXPECT_NEAR(std::erf(beckmann::detail::erf_inverse(x)), x, 3e-7f);
}

struct Albedo {
  MicrofacetDistribution distribution;
  float alpha;
  double facing, at_60;
};

// Directional albedo with F = 1 and separable exact masking, by quadrature done elsewhere in double
// precision.
constexpr Albedo k_albedos[] = {
    {k_ggx, 0.04f, 0.9975, 0.9955},      {k_ggx, 0.25f, 0.9158, 0.8552},
    {k_ggx, 0.64f, 0.5552, 0.6008},      {k_ggx, 1.0f, 0.3069, 0.4091},
    {k_beckmann, 0.04f, 1.0, 1.0},       {k_beckmann, 0.25f, 1.0, 0.9465},
    {k_beckmann, 0.64f, 0.8142, 0.8456}, {k_beckmann, 1.0f, 0.4616, 0.7564}};

TEST(Microsurface, WhiteFurnaceOfReflection) {
  for (const Albedo& a : k_albedos) {
    const MicrofacetReflection lobe{{a.distribution, a.alpha, a.alpha}, Fresnel::none()};
    for (const bool tilted : {false, true}) {
      const Vec3 wo = direction(tilted ? 60.0f : 0.0f, 0.0f);
      const double albedo =
          integrate_sphere([&](Vec3 wi) { return lobe.eval(wo, wi).value.r; }, 1e-4, 64);
      const double expected = tilted ? a.at_60 : a.facing;
      // Beckmann facets are masked by a fit.
      const double tolerance = a.distribution == k_ggx ? 0.002 : 0.006;
      EXPECT_NEAR(albedo, expected, tolerance * expected) << a.alpha << " tilted " << tilted;
    }
  }
}

TEST(Microsurface, SpecularLimit) {
  EXPECT_TRUE(is_specular(3e-4f, 3e-4f));
  EXPECT_FALSE(is_specular(4e-4f, 4e-4f));
  EXPECT_FALSE(is_specular(1e-5f, 0.5f));
}

TEST(Microsurface, MakeValidClampsAndRejects) {
  Microsurface s{k_ggx, -1.0f, 7.0f};
  EXPECT_TRUE(s.make_valid());
  EXPECT_EQ(s.alpha_x, 0.0f);
  EXPECT_EQ(s.alpha_y, 1.0f);
  s.alpha_x = std::nanf("");
  EXPECT_FALSE(s.make_valid());
}

}  // namespace
}  // namespace tenniel
