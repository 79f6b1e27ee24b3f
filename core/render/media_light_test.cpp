// SPDX-License-Identifier: Apache-2.0
// Light that media scatter, against closed forms, quadrature and other ways to estimate it.
#include <gtest/gtest.h>

#include "testing/render_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr double k_pi_d = 3.14159265358979;

void expect_mean(const Mean& found, double wanted, double tolerance) {
  EXPECT_LT(found.error, 0.5 * tolerance * wanted);
  EXPECT_NEAR(found.value, wanted, 3.0 * found.error + tolerance * wanted);
}

double henyey_greenstein(double cosine, double g) {
  const double d = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * k_pi_d * d * std::sqrt(d));
}

// A slab far wider than deep, its top at z = 0, seen at `mu` by a small camera and lit by a sun of
// perpendicular irradiance pi at `mu0` from the opposite side.
SceneBuilder lit_slab(NodeGraph medium, float depth, float mu, float mu0) {
  SceneBuilder b;
  const float wide = 2000.0f, half = 0.5f * depth;
  b.object(box(), std::move(medium), {wide, 0, 0, 0, 0, wide, 0, 0, 0, 0, half, -half});
  const auto angle = [](float cosine) {
    return std::acos(cosine) * 180.0f / static_cast<float>(k_pi_d);
  };
  b.lamp("SUN", static_cast<float>(k_pi_d), turned(angle(mu0), 0.0f, 0.0f, 0.0f)).angle = 0.0f;
  const float sine = std::sqrt(1.0f - mu * mu);
  b.ortho_camera(turned(-angle(mu), 0.0f, 5.0f * sine, 5.0f * mu), 0.01f);
  b.scene.settings.max_bounces = b.scene.settings.volume_bounces = 1024;
  return b;
}

TEST(MediaLightStatistics, SlabScattersOnceByTheClosedForm) {
  for (const float g : {0.0f, 0.6f}) {
    for (const float mu0 : {1.0f, 0.5f}) {
      const float sigma = 0.7f, depth = 2.0f, albedo = 0.6f, mu = 0.8f;
      SceneBuilder b = lit_slab(scatter(sigma, g, albedo), depth, mu, mu0);
      b.scene.settings.volume_bounces = 0;
      b.scene.settings.samples = 1024;
      // Principled Volume absorbs what its colour lacks: extinction `sigma`.
      const double tau = sigma * depth;
      // Sun and camera lie on opposite sides of the normal.
      const double cosine = std::sqrt((1.0 - mu * mu) * (1.0 - mu0 * mu0)) - mu * mu0;
      const double wanted = albedo * henyey_greenstein(cosine, g) * k_pi_d * mu0 / (mu + mu0) *
                            (1.0 - std::exp(-tau * (1.0 / mu0 + 1.0 / mu)));
      expect_mean(mean_of(render(std::move(b.scene))), wanted, 2e-3);
    }
  }
}

// Isotropic, semi-infinite: L = w / (4 pi) E mu0 / (mu + mu0) H(mu) H(mu0) (Chandrasekhar 1960).
TEST(MediaLightStatistics, ThickSlabReflectsByTheHFunctions) {
  struct Case {
    float albedo, mu, mu0;
    double h, h0;
    float depth;
  };
  const Case cases[] = {
      {0.5f, 1.0f, 0.5f, 1.25126, 1.18774, 50.0f},
      {0.8f, 0.5f, 0.2f, 1.41326, 1.22864, 50.0f},
      {0.95f, 1.0f, 0.2f, 2.07712, 1.33734, 60.0f},
      {0.99f, 0.5f, 1.0f, 1.84860, 2.47279, 200.0f},
  };
  for (const Case& c : cases) {
    SceneBuilder b = lit_slab(scatter(1.0f, 0.0f, c.albedo), c.depth, c.mu, c.mu0);
    b.scene.settings.samples = c.albedo > 0.9f ? 3072 : 1024;
    const double wanted = c.albedo / 4.0 * c.mu0 / (c.mu + c.mu0) * c.h * c.h0;
    expect_mean(mean_of(render(std::move(b.scene))), wanted, 5e-3);
  }
}

// Airlight of a point lamp beside the view, in fog without end: one integral along the view.
TEST(MediaLightStatistics, PointLampInFogIsItsAirlight) {
  constexpr double k_sigma_s = 0.06, k_sigma_t = 0.1, k_g = 0.4, k_beside = 0.3, k_ahead = 5.0;
  double wanted = 0.0;
  constexpr int k_steps = 400000;
  constexpr double k_end = 200.0, k_step = k_end / k_steps;
  for (int i = 0; i < k_steps; ++i) {
    const double s = (i + 0.5) * k_step;
    const double r2 = k_beside * k_beside + (s - k_ahead) * (s - k_ahead), r = std::sqrt(r2);
    // Light travels from the lamp to the point, then back to the camera.
    const double cosine = (k_ahead - s) / r;
    wanted +=
        k_step * k_sigma_s * henyey_greenstein(cosine, k_g) * std::exp(-k_sigma_t * (r + s)) / r2;
  }
  SceneBuilder b;
  GraphBuilder g("fog", "ShaderNodeOutputWorld");
  const uint32_t v = g.add("ShaderNodeVolumePrincipled",
                           {{"Color", grey(0.6f)}, {"Density", {0.1f}}, {"Anisotropy", {0.4f}}});
  b.scene.worlds[0].graph = g.volume(v).build();
  b.lamp("POINT", 4.0f * static_cast<float>(k_pi_d), at(0.3f, 0.0f, 0.0f));
  b.ortho_camera(at(0.0f, 0.0f, 5.0f), 1e-4f);
  b.scene.settings.volume_bounces = 0;
  b.scene.settings.samples = 16384;
  expect_mean(mean_of(render(std::move(b.scene))), wanted, 2e-3);
}

// Sampled light and light that the phase function meets by chance.
TEST(MediaLightStatistics, LightSamplingAndChanceAgree) {
  const auto lamp_of = [](bool sampled, bool is_mesh) {
    SceneBuilder b;
    b.object(sphere(), scatter(1.5f, 0.5f, 0.8f));
    if (is_mesh) {
      b.object(square(), emission(6.0f), at(0.2f, 0.3f, 1.8f, 0.6f)).visibility.ray_kinds = 0x3e;
      b.scene.materials.back().sample_as_light = sampled;
    } else {
      b.world(0.7f);
      b.scene.worlds[0].sampling = sampled ? "AUTOMATIC" : "NONE";
    }
    b.ortho_camera(turned(70.0f, 0.0f, -5.0f, 1.8f), 0.01f);
    b.scene.settings.samples = 2048;
    return mean_of(render(std::move(b.scene)));
  };
  for (const bool is_mesh : {true, false}) {
    const Mean sampled = lamp_of(true, is_mesh), chance = lamp_of(false, is_mesh);
    EXPECT_LT(chance.error, 0.02 * chance.value);
    EXPECT_NEAR(sampled.value, chance.value,
                4.0 * std::hypot(sampled.error, chance.error) + 1e-3 * chance.value);
  }
}

TEST(MediaLight, WhatIsHiddenFromScatteringLightsNoFog) {
  for (const uint32_t kinds : {0x2fu, 0x3fu}) {
    SceneBuilder b;
    b.object(box(), scatter(0.5f));
    b.object(sphere(), emission(5.0f), at(0.0f, 0.0f, 3.0f)).visibility.ray_kinds = kinds;
    b.ortho_camera(turned(90.0f, 0.0f, -5.0f, 0.0f), 1.0f);
    const double seen = mean_of(render(std::move(b.scene))).value;
    EXPECT_EQ(seen > 0.01, kinds == 0x3fu);
    EXPECT_EQ(seen == 0.0, kinds != 0x3fu);
  }
}

// A shadow ray that goes on behind a boundary ends at the light, close as that may be.
TEST(MediaLightStatistics, LightCloseToTheBoundaryIsNotShadowedByItself) {
  const auto picture = [](bool sampled) {
    SceneBuilder b;
    // Far from the origin, where rays start farther off the boundary.
    b.object(box(), scatter(0.6f), at(0.0f, 0.0f, 50.0f));
    b.object(sphere(), emission(20.0f), at(0.0f, 0.0f, 51.6f, 0.3f));
    b.scene.materials.back().sample_as_light = sampled;
    b.ortho_camera(turned(90.0f, 0.0f, -5.0f, 50.7f), 0.01f);
    b.scene.settings.samples = sampled ? 1024 : 8192;
    b.scene.settings.volume_bounces = 0;
    return mean_of(render(std::move(b.scene)));
  };
  const Mean sampled = picture(true), chance = picture(false);
  EXPECT_LT(chance.error, 0.01 * chance.value);
  EXPECT_NEAR(sampled.value, chance.value,
              4.0 * std::hypot(sampled.error, chance.error) + 1e-3 * chance.value);
}

// Without anything in it a volume changes no bit of the picture.
TEST(MediaLight, EmptyVolumeLeavesThePictureAsItIs) {
  const auto picture = [](bool with_volume) {
    SceneBuilder b;
    b.world(0.3f);
    GraphBuilder g("matte");
    g.surface(g.add("ShaderNodeBsdfDiffuse", {{"Color", grey(0.7f)}}));
    if (with_volume) g.volume(g.add("ShaderNodeVolumeScatter", {{"Density", {0.0f}}}));
    b.object(sphere(), g.build());
    b.lamp("POINT", 60.0f, at(1.0f, -1.0f, 3.0f)).radius = 0.2f;
    b.ortho_camera(at(0.0f, 0.0f, 5.0f), 2.5f);
    return render(std::move(b.scene)).rgba;
  };
  EXPECT_EQ(picture(false), picture(true));
}

}  // namespace
}  // namespace tenniel
