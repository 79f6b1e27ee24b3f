// SPDX-License-Identifier: Apache-2.0
#include "bsdf/hair_fiber.h"

#include <gtest/gtest.h>

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"
#include "bsdf/lobe_cases.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "testing/furnace.h"
#include "testing/statistics.h"

namespace tenniel {
namespace {

Bsdf fiber_bsdf(HairFiber fiber, Vec3 wo) {
  const Vec3 z = normalize(Vec3{0.0f, wo.y, wo.z});
  Bsdf bsdf;
  bsdf.begin(z, z, wo);
  for (const bool is_primary : {true, false}) {
    fiber.is_primary = is_primary;
    bsdf.add(fiber, Spectrum(1.0f), z, {1.0f, 0.0f, 0.0f});
  }
  bsdf.finish();
  return bsdf;
}

// What comes out of a hair that absorbs nothing is what went in, at every width, roughness and
// tilt: by sampling, and by summing the value over all directions.
TEST(HairFiber, WhiteFurnaceIsFull) {
  for (const float along : {0.2f, 0.3f, 0.6f, 1.0f}) {
    for (const float around : {0.2f, 0.7f}) {
      for (const float tilt : {0.0f, 0.0349f, -0.15f}) {
        for (const float offset : {-0.9f, 0.0f, 0.5f}) {
          HairFiber fiber = HairFiber::from_roughness(along, around, 0.3f);
          fiber.tilt = tilt;
          fiber.offset = offset;
          for (const float theta : {0.0f, 40.0f, 80.0f}) {
            const Vec3 wo = direction(theta, 0.0f);
            const Bsdf bsdf = fiber_bsdf(fiber, wo);
            LocalRandom random(1);
            testing::RunningStatistics by_samples, by_value;
            for (int i = 0; i < 4000; ++i) {
              const auto s = bsdf.sample(random.get_2d());
              by_samples.add(s ? static_cast<double>(s->weight.g) : 0.0);
              const Vec3 wi = warp_uniform_sphere(random.get_2d());
              by_value.add(4.0 * k_pi * static_cast<double>(bsdf.eval(wi).value.g));
            }
            EXPECT_NEAR(by_samples.mean(), 1.0, 0.01) << along << around << tilt << theta;
            EXPECT_NEAR(by_value.mean(), 1.0, 0.01 + 4.5 * by_value.standard_error())
                << along << " " << around << " " << tilt << " " << theta << " " << offset;
          }
        }
      }
    }
  }
}

// The orders are those of a ray in a clear cylinder: R + TT + TRT + ... of a head-on ray.
TEST(HairFiber, AttenuationIsThatOfARayThroughTheMiddle) {
  HairFiber fiber = HairFiber::from_roughness(0.3f, 0.3f, 0.0f);
  fiber.absorption = {0.5f, 1.0f, 2.0f};
  const Vec3 wo{0.0f, 0.0f, 1.0f};
  const float f = sqr((fiber.eta - 1.0f) / (fiber.eta + 1.0f));
  EXPECT_NEAR(fiber.albedo(wo).r, f, 1e-6f);
  fiber.is_primary = false;
  const Spectrum inside = fiber.albedo(wo);
  for (const auto& [got, sigma] : {std::pair{inside.r, 0.5f}, {inside.g, 1.0f}, {inside.b, 2.0f}}) {
    const float t = std::exp(-2.0f * sigma);
    EXPECT_NEAR(got, sqr(1.0f - f) * t / (1.0f - f * t), 1e-5f);
  }
}

// A narrow reflection follows the mirror law of the point that was hit.
TEST(HairFiber, ReflectsAboutItsRoundNormal) {
  HairFiber fiber = HairFiber::from_roughness(0.05f, 0.02f, 0.0f);
  for (const float offset : {-0.6f, 0.0f, 0.5f}) {
    fiber.offset = offset;
    const Vec3 wo = normalize(Vec3{0.4f, 0.0f, 0.9f});
    const Vec3 normal{0.0f, offset, std::sqrt(1.0f - sqr(offset))};
    const Vec3 mirrored = normal * (2.0f * dot(wo, normal)) - wo;
    LocalRandom random(3);
    Vec3 sum;
    for (int i = 0; i < 2000; ++i)
      if (const auto s = fiber.sample(wo, random.get_2d())) sum += s->wi;
    EXPECT_GT(dot(normalize(sum), mirrored), 0.999f) << offset;
  }
}

// The fit of the paper, and two pigments beside each other.
TEST(HairFiber, ColoursComeFromAbsorption) {
  const Spectrum sigma = HairFiber::absorption_of({1.0f, 0.5f, 0.1f}, 0.3f);
  EXPECT_EQ(sigma.r, 0.0f);
  EXPECT_LT(sigma.g, sigma.b);
  EXPECT_NEAR(sigma.g, sqr(std::log(0.5f) / 5.8884f), 1e-5f);
  EXPECT_TRUE(is_finite(HairFiber::absorption_of({}, 0.3f)));
  const Spectrum both = HairFiber::absorption_of_melanin(1.0f, 2.0f);
  EXPECT_NEAR(both.b, 1.653f + 2.0f * 1.924f, 1e-6f);
}

}  // namespace
}  // namespace tenniel
