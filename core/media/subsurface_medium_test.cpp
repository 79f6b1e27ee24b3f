// SPDX-License-Identifier: Apache-2.0
#include "media/subsurface_medium.h"

#include <gtest/gtest.h>

#include "math/frame.h"
#include "media/dwivedi.h"
#include "testing/chi2.h"

namespace tenniel {
namespace {

using namespace testing;

TEST(DwivediStatistics, DirectionsFollowTheDensity) {
  constexpr float k_albedos[] = {0.2f, 0.5f, 0.9f, 0.999f, 0.999999f};
  for (const float albedo : k_albedos) {
    const Dwivedi guide(albedo);
    const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
      const float cosine = guide.sample(u.x), sine = safe_sqrt(1.0f - sqr(cosine));
      return Vec3{sine * std::cos(k_two_pi * u.y), sine * std::sin(k_two_pi * u.y), cosine};
    };
    const auto pdf = [&](Vec3 w) { return guide.pdf(w.z); };
    const auto result = chi2_test(PeakDomain{Frame::from_normal({0.0f, 0.0f, 1.0f})}, draw, pdf);
    EXPECT_EQ(result.failure(sidak(0.01, static_cast<int>(std::size(k_albedos)))), "") << albedo;
  }
}

TEST(Dwivedi, GuidesTheMoreTheMoreIsAbsorbed) {
  EXPECT_GT(Dwivedi(0.3f).pdf(1.0f), Dwivedi(0.9f).pdf(1.0f));
  EXPECT_NEAR(Dwivedi(0.999999f).pdf(1.0f), 0.25f * k_inv_pi, 1e-3f);
  for (const float albedo : {0.2f, 0.6f, 0.999999f}) {
    EXPECT_GE(Dwivedi(albedo).stretching(1.0f), 0.0f);
    EXPECT_LE(Dwivedi(albedo).stretching(-1.0f), 2.0f);
    EXPECT_TRUE(std::isfinite(Dwivedi(albedo).pdf(1.0f)));
  }
}

TEST(SubsurfaceMedium, AlbedoGrowsWithTheColor) {
  for (const float g : {0.0f, 0.4f, 0.9f}) {
    float last = 0.0f;
    for (float color = 0.0f; color <= 1.0f; color += 0.05f) {
      const SubsurfaceMedium medium(Spectrum(color), Spectrum(0.1f), g);
      const float effective = medium.single_albedo.g * medium.scale.g;
      EXPECT_GE(effective, last);
      EXPECT_GE(medium.single_albedo.g, 0.2f);
      EXPECT_LT(medium.single_albedo.g, 1.0f);
      last = effective;
    }
  }
}

TEST(SubsurfaceMedium, MeanFreePathIsThatOfSimilarScattering) {
  const SubsurfaceMedium medium(Spectrum(0.8f), {0.5f, 0.1f, 0.0f}, 0.6f);
  EXPECT_NEAR(medium.sigma_t.r, 1.0f / (0.5f * 0.4f), 1e-4f);
  EXPECT_NEAR(medium.sigma_t.g, 1.0f / (0.1f * 0.4f), 1e-3f);
  EXPECT_TRUE(std::isfinite(medium.sigma_t.b));
  const SubsurfaceMedium similar = medium.similar();
  EXPECT_EQ(similar.anisotropy, 0.0f);
  EXPECT_NEAR(similar.sigma_s().g, 0.4f * medium.sigma_s().g, 1e-3f);
  EXPECT_NEAR((similar.sigma_t - similar.sigma_s()).g, (medium.sigma_t - medium.sigma_s()).g,
              1e-4f);
}

}  // namespace
}  // namespace tenniel
