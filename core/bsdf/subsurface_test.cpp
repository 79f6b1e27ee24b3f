// SPDX-License-Identifier: Apache-2.0
#include "bsdf/subsurface.h"

#include <gtest/gtest.h>

#include "bsdf/bsdf.h"
#include "bsdf/burley_profile.h"
#include "math/ray.h"
#include "testing/chi2.h"

namespace tenniel {
namespace {

using namespace testing;

TEST(BurleyProfile, EachChannelIntegratesToOne) {
  const BurleyProfile profile({0.01f, 0.3f, 2.0f});
  double r = 0.0, g = 0.0, b = 0.0;
  constexpr double k_step = 1e-4;  // in units of what is left to 32 m, on a logarithmic scale
  for (double x = -9.0; x < std::log(32.0); x += k_step) {
    const double distance = std::exp(x + 0.5 * k_step);
    const Spectrum density = profile.density(static_cast<float>(distance));
    r += density.r * distance * k_step;
    g += density.g * distance * k_step;
    b += density.b * distance * k_step;
  }
  EXPECT_NEAR(r, 1.0, 0.01);  // what lies below exp(-9) is left out
  EXPECT_NEAR(g, 1.0, 1e-3);
  EXPECT_NEAR(b, 1.0, 1e-3);
}

TEST(BurleyProfileStatistics, DistancesFollowTheDensity) {
  const Spectrum lengths[] = {{0.1f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.02f}, {0.1f, 0.05f, 0.01f}};
  for (const Spectrum length : lengths) {
    const BurleyProfile profile(length);
    const auto draw = [&](Vec2 u) -> std::optional<float> {
      const auto drawn = profile.sample(u.x);
      EXPECT_LE(drawn.r, drawn.farthest);
      return drawn.r;
    };
    const auto pdf = [&](float r) { return profile.pdf(r); };
    Chi2Options options;
    options.bins_x = 400;
    options.bins_y = 1;
    EXPECT_EQ(chi2_test(LineDomain{0.0f, 1.6f}, draw, pdf, options).failure(sidak(0.01, 3)), "")
        << length.r;
  }
}

// What a probe along the normal of a plane draws: a point of the disk.
TEST(BurleyProfileStatistics, PointsOfTheDiskFollowTheDensity) {
  const BurleyProfile profile({0.1f, 0.05f, 0.02f});
  const auto draw = [&](Vec2 u) -> std::optional<Vec2> {
    const float r = profile.sample(u.x).r, phi = k_two_pi * u.y;
    return Vec2{r * std::cos(phi), r * std::sin(phi)};
  };
  const auto pdf = [&](Vec2 p) {
    const float r = std::max(std::sqrt(dot(p, p)), 1e-6f);
    return profile.pdf(r) / (k_two_pi * r);
  };
  Chi2Options options;
  options.bins_x = options.bins_y = 20;
  const PlaneDomain domain{{-1.7f, -1.7f}, {1.7f, 1.7f}};
  EXPECT_EQ(chi2_test(domain, draw, pdf, options).failure(0.01), "");
}

TEST(BurleyProfile, NothingToSample) {
  EXPECT_TRUE(BurleyProfile(Spectrum()).empty());
  EXPECT_FALSE(BurleyProfile({0.0f, 1.0f, 0.0f}).empty());
}

// The dipole of the albedo that the scale stands for reflects what was asked for, as well as twelve
// halvings tell: the brighter, the less.
TEST(SubsurfaceRadius, ScaleInvertsTheDipole) {
  for (const double ior : {1.01, 1.4, 2.0}) {
    const double reflected = -1.44 / (ior * ior) + 0.71 / ior + 0.668 + 0.0636 * ior;
    const double a = (1.0 + reflected) / (1.0 - reflected);
    for (const double color : {0.02, 0.2, 0.5, 0.6}) {
      const double s = subsurface_radius_scale(SubsurfaceMethod::random_walk,
                                               static_cast<float>(color), static_cast<float>(ior));
      const double albedo = 1.0 - s * s / 3.0;
      const double found = 0.5 * albedo * (1.0 + std::exp(-4.0 / 3.0 * a * s)) * std::exp(-s);
      EXPECT_NEAR(found, color, 6e-3) << ior;
    }
  }
  EXPECT_FLOAT_EQ(subsurface_radius_scale(SubsurfaceMethod::random_walk, 0.0f, 1.4f),
                  std::sqrt(3.0f));
  EXPECT_GT(subsurface_radius_scale(SubsurfaceMethod::random_walk, 1.0f, 1.4f), 0.0f);
  EXPECT_FLOAT_EQ(subsurface_radius_scale(SubsurfaceMethod::fixed_radius_walk, 0.3f, 2.0f),
                  0.25f * k_inv_pi);
}

Subsurface lobe_with(Spectrum radius) {
  Subsurface lobe;
  lobe.color = Spectrum(0.5f);
  lobe.radius = radius;
  return lobe;
}

TEST(Subsurface, IsChosenAmongOtherLobesAndHasNoDensity) {
  const Vec3 n{0.0f, 0.0f, 1.0f}, bent = normalize(Vec3{0.2f, 0.0f, 1.0f});
  Bsdf bsdf;
  bsdf.begin(n, n, n);
  bsdf.add(lobe_with(Spectrum(0.1f)), Spectrum(0.6f), bent);
  bsdf.add(Diffuse{}, Spectrum(0.2f), n);
  bsdf.finish();
  EXPECT_TRUE(bsdf.lobes().has(LobeClass::diffuse));
  // A quarter of the samples, so a quarter of the density.
  EXPECT_NEAR(bsdf.eval(n).pdf, 0.25f * k_inv_pi, 1e-5f);
  EXPECT_NEAR(bsdf.eval(n).value.g, 0.2f * k_inv_pi, 1e-5f);
  const auto below = bsdf.sample({0.6f, 0.3f});
  ASSERT_TRUE(below && below->subsurface);
  EXPECT_NEAR(below->weight.g, 0.8f, 1e-5f);
  EXPECT_NEAR(below->u_below.x, 0.8f, 1e-5f);
  EXPECT_EQ(below->u_below.y, 0.3f);
  EXPECT_GT(dot(below->wi, bent), 1.0f - 1e-6f);
  EXPECT_GT(dot(bsdf.subsurface_normal(), bent), 1.0f - 1e-6f);
  const auto above = bsdf.sample({0.9f, 0.3f});
  ASSERT_TRUE(above);
  EXPECT_EQ(above->subsurface, nullptr);
}

TEST(Subsurface, BrokenParametersAreLeftOut) {
  const Vec3 n{0.0f, 0.0f, 1.0f};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Spectrum radius :
       {Spectrum(0.0f), Spectrum(-1.0f), Spectrum(nan), Spectrum(k_infinity)}) {
    Bsdf bsdf;
    bsdf.begin(n, n, n);
    bsdf.add(lobe_with(radius), Spectrum(1.0f), n);
    bsdf.finish();
    EXPECT_TRUE(bsdf.empty()) << radius.r;
  }
}

}  // namespace
}  // namespace tenniel
