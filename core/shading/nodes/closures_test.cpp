// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/closures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bsdf/fresnel.h"
#include "math/numeric.h"
#include "shading/nodes/principled.h"

namespace tenniel {
namespace {

ShadingContext context_toward(Vec3 wo, bool is_back_facing = false) {
  ShadingContext context;
  context.surface.wo = normalize(wo);
  context.surface.geometric_normal = context.surface.shading_normal = {0, 0, 1};
  context.surface.is_back_facing = is_back_facing;
  context.begin(k_query_surface);
  return context;
}

template <class Node>
const Bsdf& evaluated(const Node& node, ShadingContext& context) {
  node.eval(context);
  context.bsdf.finish();
  return context.bsdf;
}

constexpr Vec3 k_slanted{0.6f, 0.0f, 0.8f};

TEST(Closures, DiffuseIsLambertian) {
  ShadingContext context = context_toward(k_slanted);
  DiffuseNode node;
  node.weight.value = 0.5f;
  const BsdfEval e = evaluated(node, context).eval({0, 0, 1});
  EXPECT_NEAR(e.value.g, 0.5f * 0.8f * k_inv_pi, 1e-6f);
}

TEST(Closures, RoughDiffuseDiffersFromLambert) {
  ShadingContext context = context_toward(k_slanted);
  DiffuseNode node;
  node.weight.value = 1.0f;
  node.roughness.value = 1.0f;
  const Vec3 wi = normalize(Vec3{0.9f, 0.0f, 0.2f});
  EXPECT_GT(evaluated(node, context).eval(wi).value.g, 0.8f * k_inv_pi * wi.z * 1.05f);
}

TEST(Closures, ConductorReflectsByItsComplexIndex) {
  ConductorNode node;
  node.weight.value = 0.5f;
  node.eta.value = {0.14304f, 0.4116f, -1.0f};  // what cannot be is taken for 0
  node.k.value = {3.983f, 2.35978f, 1.71848f};
  for (const auto distribution : {GlossyDistribution::sharp, GlossyDistribution::ggx}) {
    ShadingContext context = context_toward(k_slanted);
    node.distribution = distribution;
    const Spectrum found = evaluated(node, context).albedo();
    EXPECT_NEAR(found.r, 0.5f * fresnel_conductor(0.8f, 0.14304f, 3.983f), 1e-6f);
    EXPECT_NEAR(found.g, 0.5f * fresnel_conductor(0.8f, 0.4116f, 2.35978f), 1e-6f);
    EXPECT_NEAR(found.b, 0.5f * fresnel_conductor(0.8f, 0.0f, 1.71848f), 1e-6f);
  }
}

TEST(Closures, GlassSplitsByTheMacroscopicFresnelTerm) {
  for (const bool back : {false, true}) {
    ShadingContext context = context_toward(k_slanted, back);
    GlassNode node;
    node.weight.value = 1.0f;
    node.ior.value = 1.5f;
    node.distribution = GlossyDistribution::sharp;
    const Bsdf& bsdf = evaluated(node, context);
    const float f = fresnel_dielectric(0.8f, back ? 1.0f / 1.5f : 1.5f);
    EXPECT_NEAR(bsdf.albedo(LobeSet::of(LobeClass::glossy)).r, f, 1e-6f);
    EXPECT_NEAR(bsdf.albedo(LobeSet::of(LobeClass::transmission)).r, 1.0f - f, 1e-6f);
  }
}

TEST(Closures, RefractionBendsBySnell) {
  ShadingContext context = context_toward(k_slanted);
  RefractionNode node;
  node.weight.value = 1.0f;
  node.ior.value = 1.5f;
  const auto sample = evaluated(node, context).sample({0.5f, 0.5f});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->wi.x, -0.6f / 1.5f, 1e-5f);
  EXPECT_LT(sample->wi.z, 0.0f);
}

TEST(Closures, EmissionThatNoPictureCanHoldIsDropped) {
  for (const float strength :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 3e38f}) {
    ShadingContext context = context_toward(k_slanted);
    EmissionNode light;
    light.weight.value = 1.0f;
    light.strength.value = strength;
    light.eval(context);
    EXPECT_EQ(context.emission, Spectrum());
    EXPECT_NE(light.note(), nullptr);
  }
  EmissionNode bright;
  bright.strength.value = k_max_emission;
  EXPECT_EQ(bright.note(), nullptr);
}

TEST(Closures, TransparencyEmissionAndHoldoutGoToTheContext) {
  ShadingContext context = context_toward(k_slanted);
  TransparentNode clear;
  clear.weight.value = 0.5f;
  clear.color.value = Spectrum(1.0f, 0.5f, 0.0f);
  clear.eval(context);
  EmissionNode light;
  light.weight.value = 0.5f;
  light.strength.value = 4.0f;
  light.eval(context);
  BackgroundNode sky;
  sky.weight.value = 1.0f;
  sky.eval(context);
  HoldoutNode hole;
  hole.weight.value = 0.25f;
  hole.eval(context);
  EXPECT_EQ(context.transparency, Spectrum(0.5f, 0.25f, 0.0f));
  EXPECT_EQ(context.emission, Spectrum(2.8f));
  EXPECT_EQ(context.holdout, 0.25f);
  EXPECT_TRUE(context.bsdf.empty());
}

TEST(Closures, AnisotropyStretchesAcrossTheTangent) {
  ShadingContext context = context_toward({0, 0, 1});
  AnisotropicNode node;
  node.weight.value = 1.0f;
  node.anisotropy.value = 0.8f;
  node.tangent = {{1, 0, 0}, 0};  // read from register 0
  context.reserve(3);
  context.set(Output<Vec3>{0}, Vec3{1, 0, 0});
  const Bsdf& bsdf = evaluated(node, context);
  const float along = bsdf.eval(normalize(Vec3{0.5f, 0.0f, 1.0f})).value.r;
  const float across = bsdf.eval(normalize(Vec3{0.0f, 0.5f, 1.0f})).value.r;
  EXPECT_GT(across, 2.0f * along);
}

PrincipledV1Node principled() {
  PrincipledV1Node node;
  node.weight.value = 1.0f;
  return node;
}

TEST(Principled, DefaultHasDiffuseAndGlossyOnly) {
  ShadingContext context = context_toward(k_slanted);
  const Bsdf& bsdf = evaluated(principled(), context);
  EXPECT_TRUE(bsdf.lobes().has(LobeClass::diffuse) && bsdf.lobes().has(LobeClass::glossy));
  EXPECT_FALSE(bsdf.lobes().has(LobeClass::transmission));
  EXPECT_NEAR(bsdf.albedo(LobeSet::of(LobeClass::diffuse)).r, 0.8f, 1e-6f);
  EXPECT_EQ(context.transparency, Spectrum());
}

TEST(Principled, SpecularFacesTheViewerWithEightPercentOfSpecular) {
  ShadingContext context = context_toward({0, 0, 1});
  PrincipledV1Node node = principled();
  node.base_color.value = Spectrum();
  node.roughness.value = 0.0f;
  const auto sample = evaluated(node, context).sample({0.5f, 0.5f});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->weight.r, 0.04f, 1e-5f);
}

TEST(Principled, MetalIsTheBaseColourFacingTheViewer) {
  ShadingContext context = context_toward({0, 0, 1});
  PrincipledV1Node node = principled();
  node.base_color.value = Spectrum(0.9f, 0.6f, 0.2f);
  node.metallic.value = 1.0f;
  node.roughness.value = 0.0f;
  const Bsdf& bsdf = evaluated(node, context);
  EXPECT_FALSE(bsdf.lobes().has(LobeClass::diffuse));
  const auto sample = bsdf.sample({0.5f, 0.5f});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->weight.r, 0.9f, 1e-4f);
  EXPECT_NEAR(sample->weight.b, 0.2f, 1e-4f);
}

TEST(Principled, AlphaDimsEverythingButTransparency) {
  ShadingContext context = context_toward(k_slanted);
  PrincipledV1Node node = principled();
  node.weight.value = 0.5f;
  node.alpha.value = 0.25f;
  node.emission.value = Spectrum(2.0f);
  const Bsdf& bsdf = evaluated(node, context);
  EXPECT_EQ(context.transparency, Spectrum(0.375f));
  EXPECT_EQ(context.emission, Spectrum(0.25f));
  EXPECT_NEAR(bsdf.albedo(LobeSet::of(LobeClass::diffuse)).r, 0.1f, 1e-6f);
}

TEST(Principled, NamesItsParts) {
  PrincipledV1Node node = principled();
  EXPECT_EQ(node.closure_parts(), k_query_scatter);
  EXPECT_FALSE(node.has_subsurface());
  node.emission.value = Spectrum(1.0f);
  node.alpha.source = 0;
  EXPECT_EQ(node.closure_parts(), k_query_surface);
  node.alpha = {0.0f};
  EXPECT_EQ(node.closure_parts(), k_query_transparency);
  node.subsurface.value = 0.1f;
  EXPECT_TRUE(node.has_subsurface());
}

// Every parameter at the ends of its range, from head-on to grazing.
TEST(Principled, IsFiniteAtTheCorners) {
  int samples = 0;
  for (int corner = 0; corner < 512; ++corner) {
    const auto end = [corner](int bit) { return (corner >> bit & 1) ? 1.0f : 0.0f; };
    PrincipledV1Node node = principled();
    node.base_color.value = Spectrum(end(0), 1.0f, 0.0f);
    node.metallic.value = end(1);
    node.specular.value = 4.0f * end(2);
    node.roughness.value = end(3);
    node.anisotropic.value = end(4);
    node.sheen.value = node.specular_tint.value = end(5);
    node.clearcoat.value = node.clearcoat_roughness.value = end(6);
    node.transmission.value = end(7);
    node.ior.value = end(8) > 0.0f ? 1000.0f : 0.0f;
    for (const Vec3 wo : {Vec3{0, 0, 1}, Vec3{0.7f, 0, 0.7f}, Vec3{1, 0, 1e-4f}}) {
      ShadingContext context = context_toward(wo, corner % 2 == 1);
      const Bsdf& bsdf = evaluated(node, context);
      for (const float u : {0.01f, 0.3f, 0.6f, 0.99f}) {
        const auto s = bsdf.sample({u, 0.37f});
        if (!s) continue;
        ++samples;
        ASSERT_TRUE(is_finite(s->weight) && is_finite(s->wi) && s->pdf > 0.0f) << corner;
        const BsdfEval e = bsdf.eval(s->wi);
        ASSERT_TRUE(is_finite(e.value) && std::isfinite(e.pdf)) << corner;
      }
    }
  }
  EXPECT_GT(samples, 3000);
}

}  // namespace
}  // namespace tenniel
