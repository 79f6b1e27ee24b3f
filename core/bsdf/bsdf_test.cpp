// SPDX-License-Identifier: Apache-2.0
#include "bsdf/bsdf.h"

#include <gtest/gtest.h>

#include "bsdf/lobe_cases.h"
#include "bsdf/shading_normal.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "testing/chi2.h"
#include "testing/furnace.h"
#include "testing/z_test.h"

namespace tenniel {
namespace {

constexpr Vec3 k_up{0.0f, 0.0f, 1.0f};
const LobeSet k_diffuse = LobeSet::of(LobeClass::diffuse);
const LobeSet k_glossy = LobeSet::of(LobeClass::glossy);
const LobeSet k_transmission = LobeSet::of(LobeClass::transmission);

MicrofacetReflection ggx(float alpha) {
  return {{MicrofacetDistribution::ggx, alpha, alpha}, Fresnel::none()};
}
MicrofacetRefraction rough_glass(float alpha, float eta) {
  return {{MicrofacetDistribution::beckmann, alpha, alpha}, eta};
}

// Lobes of every class whose samples have an exact density, each around its own normal.
Bsdf mixture(Vec3 wo) {
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, wo);
  bsdf.add(Diffuse{}, {0.3f, 0.2f, 0.1f}, k_up);
  bsdf.add(OrenNayar{0.8f}, Spectrum(0.1f), normalize({0.3f, 0.1f, 1.0f}));
  bsdf.add(ggx(0.3f), {0.1f, 0.2f, 0.3f}, k_up, {1.0f, 0.0f, 0.0f});
  bsdf.add(AshikhminShirley{0.2f, 0.2f}, Spectrum(0.25f), normalize({-0.2f, 0.2f, 1.0f}));
  bsdf.add(rough_glass(0.4f, 1.45f), Spectrum(0.3f), k_up);
  bsdf.add(Translucent{}, Spectrum(0.1f), normalize({0.0f, 0.2f, 1.0f}));
  bsdf.finish();
  return bsdf;
}

TEST(BsdfStatistics, MixtureSamplesFollowTheDensity) {
  for (const float theta : k_angles) {
    const Bsdf bsdf = mixture(direction(theta, 40.0f));
    const auto draw = [&](float, Vec2 u) -> std::optional<Vec3> {
      const auto s = bsdf.sample(u);
      return s ? std::optional(s->wi) : std::nullopt;
    };
    const auto pdf = [&](Vec3 wi) { return bsdf.eval(wi).pdf; };
    EXPECT_EQ(testing::chi2_test(testing::SphereDomain{}, draw, pdf)
                  .failure(testing::sidak(0.01, std::size(k_angles))),
              "")
        << theta;
  }
}

// Grazing views of steep normals: raising must keep samples and density together.
TEST(BsdfStatistics, RaisedNormalsKeepTheDensity) {
  const Vec3 wo = direction(80.0f, 0.0f);
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, wo);
  const Vec3 steep = direction(50.0f, 170.0f);
  ASSERT_LT(dot(steep, wo), 0.0f);
  bsdf.add(AshikhminShirley{0.4f, 0.4f}, Spectrum(0.5f), steep);
  bsdf.add(OrenNayar{0.5f}, Spectrum(0.5f), steep);
  bsdf.finish();
  const auto draw = [&](float, Vec2 u) -> std::optional<Vec3> {
    const auto s = bsdf.sample(u);
    return s ? std::optional(s->wi) : std::nullopt;
  };
  const auto pdf = [&](Vec3 wi) { return bsdf.eval(wi).pdf; };
  EXPECT_EQ(testing::chi2_test(testing::SphereDomain{}, draw, pdf).failure(0.01), "");
}

TEST(Bsdf, SampleAgreesWithEval) {
  LocalRandom random(5);
  for (const float theta : k_angles) {
    const Bsdf bsdf = mixture(direction(theta, 40.0f));
    for (int i = 0; i < 2000; ++i) {
      const auto s = bsdf.sample(random.get_2d());
      if (!s) continue;
      const BsdfEval e = bsdf.eval(s->wi);
      EXPECT_NEAR(s->pdf, e.pdf, 2e-3f * e.pdf);
      EXPECT_NEAR(s->weight.g * s->pdf, e.value.g, 2e-3f * e.value.g + 1e-7f);
      EXPECT_TRUE(bsdf.smooth_lobes().has(s->lobe_class));
    }
  }
}

TEST(Bsdf, ValuesAndDensitiesOfDisjointSetsAddUp) {
  const Bsdf bsdf = mixture(direction(35.0f, 40.0f));
  LocalRandom random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wi = warp_uniform_sphere(random.get_2d());
    const BsdfEval all = bsdf.eval(wi);
    Spectrum value;
    float pdf = 0.0f;
    for (const LobeSet set : {k_diffuse, k_glossy, k_transmission}) {
      const BsdfEval one = bsdf.eval(wi, set, set);
      value += one.value;
      pdf += one.pdf;
      // The value of one set beside the density of all.
      const BsdfEval crossed = bsdf.eval(wi, set, LobeSet::all());
      EXPECT_TRUE(crossed.value == one.value);
      EXPECT_EQ(crossed.pdf, all.pdf);
      EXPECT_EQ(bsdf.eval(wi, LobeSet::none(), set).pdf, one.pdf);
    }
    EXPECT_NEAR(value.r, all.value.r, 1e-6f);
    EXPECT_NEAR(pdf, all.pdf, 1e-6f);
  }
}

TEST(Bsdf, MeanWeightIsTheIntegralOfTheValue) {
  const Bsdf bsdf = mixture(direction(50.0f, 40.0f));
  testing::RunningStatistics weight;
  LocalRandom random(7);
  for (int i = 0; i < 100000; ++i) {
    const auto s = bsdf.sample(random.get_2d());
    weight.add(s ? static_cast<double>(s->weight.g) : 0.0);
  }
  const double albedo = testing::integrate_sphere([&](Vec3 w) { return bsdf.eval(w).value.g; });
  EXPECT_GT(testing::z_test(weight, albedo, 1e-3), 1e-3);
  EXPECT_LT(weight.standard_error(), 3e-3 * albedo);
}

// Even numbers in the square stay even for each lobe: each half of a lobe's numbers goes to a half
// of its own directions.
TEST(Bsdf, TheChoiceOfALobeLeavesTheNumbersEven) {
  const Vec3 wo = direction(30.0f, 0.0f);
  Bsdf two, one;
  two.begin(k_up, k_up, wo);
  two.add(Translucent{}, Spectrum(0.3f), k_up);
  two.add(Diffuse{}, Spectrum(0.1f), k_up);
  two.finish();
  one.begin(k_up, k_up, wo);
  one.add(Diffuse{}, Spectrum(0.1f), k_up);
  one.finish();
  for (const float x : {0.125f, 0.25f, 0.5f, 0.96875f}) {
    const auto below = two.sample({0.75f * x, 0.4f}), above = two.sample({0.75f + 0.25f * x, 0.4f});
    const auto alone = one.sample({x, 0.4f});
    ASSERT_TRUE(below && above && alone);
    EXPECT_LT(below->wi.z, 0.0f);
    EXPECT_GT(dot(above->wi, alone->wi), 1.0f - 1e-5f);
  }
}

// How often the glossy lobe of two is chosen.
double share_of_glossy(const Lobe& lobe, float coat_least) {
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, direction(30.0f, 0.0f));
  bsdf.add(Diffuse{}, Spectrum(0.99f), k_up);
  visit_lobe([&](const auto& l) { bsdf.add(l, Spectrum(0.01f), k_up); }, lobe);
  bsdf.finish(coat_least);
  int glossy = 0;
  LocalRandom random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto s = bsdf.sample(random.get_2d());
    glossy += s && s->lobe_class == LobeClass::glossy ? 1 : 0;
  }
  return glossy / 20000.0;
}

TEST(Bsdf, CoatsAreChosenAsOftenAsAsked) {
  EXPECT_LT(share_of_glossy(Clearcoat{0.01f}, 0.0f), 0.003);
  EXPECT_NEAR(share_of_glossy(Clearcoat{0.01f}, 0.125f), 0.125 / 1.125, 0.01);
  for (const float least : {0.0f, 0.125f})
    EXPECT_NEAR(share_of_glossy(SpecularReflection{Fresnel::none()}, least), 0.01, 0.003);
}

TEST(Bsdf, DeltasAreChosenByTheirShareAndEvalIgnoresThem) {
  const Vec3 wo = direction(30.0f, 0.0f);
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, wo);
  bsdf.add(Transparent{}, {0.4f, 0.2f, 0.0f}, k_up);
  bsdf.add(SpecularReflection{}, Spectrum(0.3f), k_up);
  bsdf.add(SpecularRefraction{1.5f}, Spectrum(0.5f), k_up);
  bsdf.finish();
  EXPECT_TRUE(bsdf.smooth_lobes().empty());
  EXPECT_EQ(bsdf.transparency().r, 0.4f);
  std::array<int, 16> chosen{};
  std::array<Spectrum, 16> sum;
  constexpr int k_samples = 100000;
  LocalRandom random(8);
  for (int i = 0; i < k_samples; ++i) {
    const auto s = bsdf.sample(random.get_2d());
    ASSERT_TRUE(s && s->is_delta);
    EXPECT_EQ(s->roughness, 0.0f);
    EXPECT_TRUE(is_black(bsdf.eval(s->wi).value));
    EXPECT_EQ(bsdf.eval(s->wi).pdf, 0.0f);
    ++chosen[static_cast<size_t>(s->lobe_class)];
    sum[static_cast<size_t>(s->lobe_class)] += s->weight * (1.0f / k_samples);
    if (s->lobe_class == LobeClass::transparent) {
      EXPECT_TRUE(s->wi == -wo);
    }
  }
  const auto share = [&](LobeClass c) { return chosen[static_cast<size_t>(c)]; };
  EXPECT_GT(testing::binomial_test(share(LobeClass::transparent), k_samples, 0.2), 1e-3);
  EXPECT_GT(testing::binomial_test(share(LobeClass::glossy), k_samples, 0.3), 1e-3);
  EXPECT_GT(testing::binomial_test(share(LobeClass::transmission), k_samples, 0.5), 1e-3);
  EXPECT_NEAR(sum[static_cast<size_t>(LobeClass::transparent)].r, 0.4f, 0.01f);
  EXPECT_NEAR(sum[static_cast<size_t>(LobeClass::transmission)].b, 0.5f, 0.01f);
}

TEST(Bsdf, NoLightLeaksThroughTheGeometricSurface) {
  const Vec3 wo = direction(40.0f, 0.0f);
  const Vec3 tilted = direction(35.0f, 90.0f);
  Bsdf bsdf;
  bsdf.begin(k_up, tilted, wo);
  bsdf.add(Diffuse{}, Spectrum(0.5f), tilted);
  bsdf.add(ggx(0.6f), Spectrum(0.5f), tilted);
  bsdf.add(Translucent{}, Spectrum(0.5f), tilted);
  bsdf.finish();
  LocalRandom random(9);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 wi = warp_uniform_sphere(random.get_2d());
    const LobeSet reflecting = k_diffuse | k_glossy;
    const BsdfEval reflected = bsdf.eval(wi, reflecting, reflecting);
    const BsdfEval passed = bsdf.eval(wi, k_transmission, k_transmission);
    if (wi.z < 0.0f) {
      EXPECT_TRUE(is_black(reflected.value) && reflected.pdf == 0.0f);
    }
    if (wi.z > 0.0f) {
      EXPECT_TRUE(is_black(passed.value) && passed.pdf == 0.0f);
    }
    const auto s = bsdf.sample(random.get_2d());
    if (s) {
      EXPECT_EQ(s->wi.z < 0.0f, s->lobe_class == LobeClass::transmission);
    }
  }
}

// Where eval is black, but the true surface does not hide it.
TEST(Bsdf, GlossySamplesBelowTheHorizonOfABentNormalCount) {
  const Vec3 wo = direction(40.0f, 180.0f), bent = wo;
  for (const Lobe& lobe : {Lobe(ggx(0.6f)), Lobe(Clearcoat{0.6f})}) {
    Bsdf bsdf;
    bsdf.begin(k_up, k_up, wo);
    visit_lobe([&](const auto& l) { bsdf.add(l, Spectrum(1.0f), bent); }, lobe);
    bsdf.finish();
    LocalRandom random(8);
    int below = 0;
    for (int i = 0; i < 5000; ++i) {
      const auto s = bsdf.sample(random.get_2d());
      if (!s) continue;
      EXPECT_GT(dot(s->wi, k_up), 0.0f);
      if (dot(s->wi, bent) >= -1e-3f) continue;
      ++below;
      EXPECT_GT(s->weight.g, 0.0f);
      EXPECT_TRUE(is_black(bsdf.eval(s->wi).value));
    }
    EXPECT_GT(below, 20);
  }
}

TEST(Bsdf, BumpedDiffuseIsDimmedButNeverBrightened) {
  const Vec3 wo = direction(20.0f, 0.0f), tilted = direction(40.0f, 0.0f);
  Bsdf flat, bumped;
  flat.begin(k_up, tilted, wo);
  bumped.begin(k_up, k_up, wo);
  for (Bsdf* b : {&flat, &bumped}) {
    b->add(Diffuse{}, Spectrum(1.0f), tilted);
    b->finish();
  }
  const Vec3 towards = direction(30.0f, 0.0f), grazing = direction(85.0f, 0.0f);
  EXPECT_EQ(flat.eval(towards).pdf, bumped.eval(towards).pdf);
  EXPECT_NEAR(flat.eval(grazing).value.r, std::cos(45.0f * k_pi / 180.0f) * k_inv_pi, 1e-5f);
  EXPECT_LT(bumped.eval(grazing).value.r, 0.5f * flat.eval(grazing).value.r);
  EXPECT_GT(bumped.eval(grazing).value.r, 0.0f);
  LocalRandom random(10);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wi = warp_uniform_hemisphere(random.get_2d());
    EXPECT_LE(bumped.eval(wi).value.r, flat.eval(wi).value.r);
  }
}

TEST(Bsdf, BadLobesAreDropped) {
  const float nan = std::nanf("");
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, direction(30.0f, 0.0f));
  bsdf.add(Diffuse{}, Spectrum(0.0f), k_up);
  bsdf.add(Diffuse{}, Spectrum(-1.0f), k_up);
  bsdf.add(Diffuse{}, {1.0f, nan, 1.0f}, k_up);
  bsdf.add(Diffuse{}, Spectrum(1.0f), {nan, 0.0f, 1.0f});
  bsdf.add(ggx(nan), Spectrum(1.0f), k_up);
  bsdf.add(OrenNayar{nan}, Spectrum(1.0f), k_up);
  bsdf.add(rough_glass(0.2f, nan), Spectrum(1.0f), k_up);
  bsdf.add(SpecularReflection{Fresnel::principled({nan, 0, 0}, 1.5f)}, Spectrum(1.0f), k_up);
  bsdf.finish();
  EXPECT_TRUE(bsdf.empty() && bsdf.lobes().empty());
  EXPECT_FALSE(bsdf.sample({0.5f, 0.5f}));
  EXPECT_TRUE(is_black(bsdf.eval(k_up).value));
  EXPECT_TRUE(bsdf.average_normal() == k_up);
}

TEST(Bsdf, SurplusDropsTheSmallestWeights) {
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, k_up);
  for (int i = 1; i <= 20; ++i)
    bsdf.add(Diffuse{}, Spectrum(static_cast<float>(i)), k_up);
  bsdf.finish();
  EXPECT_NEAR(bsdf.albedo().r, 200.0f, 1e-3f);  // 5 + ... + 20
}

TEST(Bsdf, WidenTurnsARoughMirrorSoftButLeavesSharpOnes) {
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, direction(30.0f, 0.0f));
  bsdf.add(ggx(0.0f), Spectrum(1.0f), k_up);
  bsdf.add(SpecularReflection{}, Spectrum(1.0f), k_up);
  bsdf.finish();
  EXPECT_TRUE(bsdf.smooth_lobes().empty());
  bsdf.widen(0.2f);
  EXPECT_TRUE(bsdf.smooth_lobes().has(LobeClass::glossy));
  const auto soft = bsdf.sample({0.1f, 0.6f}), sharp = bsdf.sample({0.9f, 0.6f});
  ASSERT_TRUE(soft && sharp);
  EXPECT_NEAR(soft->roughness, 0.2f, 1e-6f);
  EXPECT_TRUE(!soft->is_delta && sharp->is_delta);
}

TEST(Bsdf, OnlyMirrorsAndHolesAreCertain) {
  const auto made_of = [](const std::vector<Lobe>& lobes) {
    Bsdf bsdf;
    bsdf.begin(k_up, k_up, direction(30.0f, 0.0f));
    for (const Lobe& lobe : lobes)
      bsdf.add(lobe, Spectrum(0.4f), k_up);
    bsdf.finish();
    return bsdf;
  };
  for (const Lobe& lobe : {Lobe(SpecularReflection{}), Lobe(Transparent{}), Lobe(ggx(0.0f))}) {
    const Bsdf bsdf = made_of({lobe});
    EXPECT_TRUE(bsdf.is_certain());
    const auto a = bsdf.sample({0.1f, 0.9f}), b = bsdf.sample({0.8f, 0.3f});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->wi, b->wi);
    EXPECT_EQ(a->weight, b->weight);
    EXPECT_FALSE(made_of({lobe, SpecularRefraction{1.5f}}).is_certain());
    EXPECT_FALSE(made_of({lobe, Diffuse{}}).is_certain());
  }
  EXPECT_TRUE(made_of({}).is_certain());
  Subsurface wax;
  wax.color = wax.radius = Spectrum(0.5f);
  for (const Lobe& lobe : {Lobe(Diffuse{}), Lobe(wax), Lobe(ggx(0.3f))})
    EXPECT_FALSE(made_of({lobe}).is_certain());
}

TEST(Bsdf, AlbedoAndNormalOfTheMixture) {
  Bsdf bsdf;
  bsdf.begin(k_up, k_up, k_up);
  bsdf.add(Diffuse{}, {0.5f, 0.25f, 0.0f}, k_up);
  bsdf.add(ggx(0.3f), Spectrum(0.25f), direction(20.0f, 0.0f));
  bsdf.add(ggx(0.3f), Spectrum(0.25f), direction(20.0f, 180.0f));
  bsdf.finish();
  EXPECT_NEAR(bsdf.albedo(k_diffuse).r, 0.5f, 1e-6f);
  EXPECT_NEAR(bsdf.albedo().g, 0.75f, 1e-6f);
  EXPECT_NEAR(dot(bsdf.average_normal(), k_up), 1.0f, 1e-6f);
}

TEST(ShadingNormal, ValidNormalsStay) {
  const Vec3 n = direction(20.0f, 70.0f), wo = direction(30.0f, 10.0f);
  EXPECT_TRUE(ensure_valid_reflection(k_up, wo, n) == n);
}

TEST(ShadingNormal, RaisedNormalsSeeTheViewAndReflectAboveTheSurface) {
  LocalRandom random(20);
  int raised = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 wo = warp_uniform_hemisphere(random.get_2d());
    const Vec3 n = warp_uniform_sphere(random.get_2d());
    const Vec3 valid = ensure_valid_reflection(k_up, wo, n);
    const float height = std::min(0.9f * wo.z, 0.01f);
    ASSERT_NEAR(length(valid), 1.0f, 1e-5f);
    ASSERT_GT(dot(valid, wo), 0.0f) << wo.z;
    ASSERT_GE(reflect(wo, valid).z, height - 1e-4f);
    if (valid == n) continue;
    ++raised;
    EXPECT_NEAR(reflect(wo, valid).z, height, 1e-4f);      // no more than needed
    EXPECT_NEAR(dot(cross(k_up, n), valid), 0.0f, 1e-4f);  // in the plane of both
    EXPECT_GE(dot(valid, k_up), dot(n, k_up) - 1e-5f);     // towards the surface's own
  }
  EXPECT_GT(raised, 5000);
}

}  // namespace
}  // namespace tenniel
