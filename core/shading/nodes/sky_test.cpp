// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/sky_analytic.h"
#include "shading/nodes/sky_nishita.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

const Vec3 k_directions[3] = {{0.0f, 0.0f, 1.0f}, {0.3f, 0.7f, 0.6480741f}, {-0.6f, -0.8f, 0.0f}};
const Vec3 k_to_sun = normalize({0.6f, -0.3f, 0.4f});

template <class Sky>
void expect_radiance(const Sky& sky, const Spectrum (&expected)[3], float tolerance) {
  for (size_t i = 0; i < 3; ++i) {
    const Spectrum actual = sky.radiance(k_directions[i]);
    EXPECT_NEAR(actual.r, expected[i].r, tolerance * expected[i].r) << i;
    EXPECT_NEAR(actual.g, expected[i].g, tolerance * expected[i].g) << i;
    EXPECT_NEAR(actual.b, expected[i].b, tolerance * expected[i].b) << i;
  }
}

// What Cycles 3.4.1 shows.
TEST(SkyOracle, Preetham) {
  expect_radiance(PreethamSky(k_to_sun, 3.0f),
                  {{0.192757f, 0.320362f, 0.616317f},
                   {0.209757f, 0.348464f, 0.629014f},
                   {0.478372f, 0.423142f, 0.45331f}},
                  1e-4f);
}

TEST(SkyOracle, HosekWilkie) {
  expect_radiance(HosekWilkieSky(k_to_sun, 3.4f, 0.25f),
                  {{0.0191076f, 0.0322161f, 0.0621085f},
                   {0.0286722f, 0.0495034f, 0.0878668f},
                   {0.0934992f, 0.115057f, 0.104113f}},
                  1e-4f);
}

NishitaParameters evening() {
  NishitaParameters p;
  p.sun_elevation = 0.4f;
  p.sun_rotation = 0.9f;
  p.altitude = 300.0f;
  p.dust_density = 2.0f;
  return p;
}

TEST(SkyOracle, Nishita) {
  expect_radiance(NishitaSky(evening()),
                  {{0.672401f, 1.02511f, 1.75117f},
                   {3.32118f, 3.73784f, 4.78653f},
                   {2.04193f, 2.13827f, 1.75466f}},
                  2e-4f);
}

TEST(Nishita, SunStandsWhereItIsBright) {
  const NishitaSky sky(evening());
  const auto sun = sky.sun();
  ASSERT_TRUE(sun);
  EXPECT_NEAR(length(sun->direction), 1.0f, 1e-6f);
  EXPECT_NEAR(std::asin(sun->direction.z), 0.4f, 1e-5f);
  EXPECT_NEAR(std::atan2(sun->direction.x, sun->direction.y), 0.9f, 1e-5f);
  const Vec3 beside = normalize(sun->direction + Vec3{0.0f, 0.0f, 2.2f * sun->half_angle});
  EXPECT_GT(sky.radiance(sun->direction).g, 1e3f * sky.radiance(beside).g);
  NishitaParameters hidden = evening();
  hidden.sun_disc = false;
  EXPECT_FALSE(NishitaSky(hidden).sun());
  hidden = evening();
  hidden.sun_elevation = -0.2f;
  EXPECT_FALSE(NishitaSky(hidden).sun());
}

TEST(Nishita, NightFallsBelowTheHorizon) {
  const NishitaSky sky(evening());
  EXPECT_EQ(sky.radiance({0.0f, 0.0f, -1.0f}), Spectrum());
  EXPECT_GT(sky.radiance({0.0f, 0.995f, -0.1f}).g, 0.0f);
}

TestMaterial compiled_sky(const char* texture) {
  const std::string rest =
      "\nbg: ShaderNodeBackground Color<sky.Color"
      "\nout: ShaderNodeOutputWorld Surface<bg.Background";
  return TestMaterial(GraphText::parse(texture + rest), {nullptr, ShaderDomain::world});
}

TEST(SkyNode, TellsWhereItsSunIsIfItCan) {
  const TestMaterial plain = compiled_sky("sky: ShaderNodeTexSky");
  ASSERT_EQ(plain.material.suns.size(), 1u);
  EXPECT_FALSE(plain.material.has_hidden_sun);
  const TestMaterial generated =
      compiled_sky("tc: ShaderNodeTexCoord\nsky: ShaderNodeTexSky Vector<tc.Generated");
  EXPECT_EQ(generated.material.suns.size(), 1u);
  const TestMaterial mapped = compiled_sky(
      "tc: ShaderNodeTexCoord\nmap: ShaderNodeMapping Vector<tc.Generated\n"
      "sky: ShaderNodeTexSky Vector<map.Vector");
  EXPECT_TRUE(mapped.material.suns.empty());
  EXPECT_TRUE(mapped.material.has_hidden_sun);
  const TestMaterial analytic = compiled_sky("sky: ShaderNodeTexSky @sky_type=PREETHAM");
  EXPECT_TRUE(analytic.material.suns.empty());
  EXPECT_FALSE(analytic.material.has_hidden_sun);
}

}  // namespace
}  // namespace tenniel
