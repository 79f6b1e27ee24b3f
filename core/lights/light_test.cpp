// SPDX-License-Identifier: Apache-2.0
#include "lights/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "lights/light_sampler.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "shading/nodes/coordinates.h"

namespace tenniel {
namespace {

AreaLight area_light(Vec3 center, float size, bool is_ellipse, float spread = k_pi) {
  AreaLight light;
  light.set_place(center, {size, 0.0f, 0.0f}, {0.0f, -size, 0.0f}, {0.0f, 0.0f, -1.0f});
  light.is_ellipse = is_ellipse;
  light.radiance = Spectrum(1.0f);
  light.set_spread(spread);
  return light;
}

struct LampCase {
  std::string name;
  Light light;
  float irradiance;  // closed form at the origin, normal +z; negative: not known
};

// E = pi L R^2 / (R^2 + d^2) of a disk that faces the receiver; the square's value is the form
// factor integral of a 1x1 light at distance 1 (0.7522747 L).
std::vector<LampCase> lamps() {
  std::vector<LampCase> cases;
  const auto add = [&](std::string name, LightShape shape, float irradiance) {
    Light light;
    light.shape = std::move(shape);
    cases.push_back({std::move(name), std::move(light), irradiance});
  };
  add("point", PointLight{{0.0f, 0.0f, 2.0f}, 0.5f, Spectrum(3.0f)},
      3.0f * k_pi * 0.25f / (0.25f + 4.0f));
  add("spot",
      SpotLight{{{0.3f, 0.2f, 2.0f}, 0.5f, Spectrum(3.0f)}, {0.0f, 0.0f, -1.0f}, 0.7f, 0.3f},
      -1.0f);
  add("square", area_light({0.0f, 0.0f, 1.0f}, 1.0f, false), 0.7522747f);
  // Far away, and from a point that shares none of its axes: drawn by the estimate at its corners.
  add("distant square", area_light({0.7f, -0.4f, 3.0f}, 1.0f, false), -1.0f);
  add("disk", area_light({0.0f, 0.0f, 1.0f}, 1.0f, true), k_pi * 0.25f / 1.25f);
  add("spread", area_light({0.2f, 0.1f, 1.0f}, 1.0f, false, 1.0f), -1.0f);
  // Blender's sun spreads its strength over a flat disk: the mean cosine of that disk is left over.
  add("sun", SunLight{{0.0f, 0.0f, 1.0f}, 0.1f, Spectrum(2.0f)},
      2.0f * 2.0f * (std::sqrt(1.01f) - 1.0f) / 0.01f);
  return cases;
}

const ShadingPoint k_floor{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, true};

class LampStatistics : public ::testing::TestWithParam<LampCase> {};

TEST_P(LampStatistics, SampledDirectionMeetsTheLampWithTheSamePdfAndRadiance) {
  Sampler sampler(1);
  int found = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    sampler.start_sample(0, 0, i);
    const auto drawn = sample_lamp(GetParam().light, k_floor, sampler.get_2d());
    if (!drawn) continue;
    ++found;
    const auto hit = intersect_lamp(GetParam().light, Ray{k_floor.position, drawn->wi});
    if (!hit) continue;  // on the rim
    EXPECT_NEAR(lamp_pdf(GetParam().light, k_floor, drawn->wi) / drawn->pdf, 1.0f, 2e-3f);
    EXPECT_NEAR(hit->radiance.r, drawn->radiance.r, 2e-3f * drawn->radiance.r + 1e-5f);
    if (std::isfinite(drawn->distance)) {
      EXPECT_NEAR(hit->t, drawn->distance, 1e-4f * drawn->distance);
    }
  }
  EXPECT_GT(found, 500);
}

// Light sampling, rays that meet the lamp and the closed form agree on the irradiance.
TEST_P(LampStatistics, IrradianceAgreesWithRaysAndClosedForm) {
  Sampler sampler(2);
  constexpr uint32_t k_samples = 1u << 16;
  double by_light = 0.0, by_rays = 0.0;
  for (uint32_t i = 0; i < k_samples; ++i) {
    sampler.start_sample(0, 0, i);
    if (const auto drawn = sample_lamp(GetParam().light, k_floor, sampler.get_2d()))
      by_light += drawn->radiance.r * std::max(drawn->wi.z, 0.0f) / drawn->pdf;
    // The sun is too small for cosine-distributed rays: a narrower cone around it.
    const bool narrow = GetParam().name == "sun";
    const float cap = narrow ? 0.006f : 1.0f;
    const Vec3 wi = warp_uniform_cone(sampler.get_2d(), cap);
    if (const auto hit = intersect_lamp(GetParam().light, Ray{k_floor.position, wi}))
      by_rays += hit->radiance.r * wi.z / uniform_cone_pdf(cap);
  }
  by_light /= k_samples;
  by_rays /= k_samples;
  EXPECT_GT(by_light, 0.0);
  EXPECT_NEAR(by_rays / by_light, 1.0, 0.01);
  if (GetParam().irradiance > 0.0f) {
    EXPECT_NEAR(by_light / GetParam().irradiance, 1.0, 0.002);
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, LampStatistics, ::testing::ValuesIn(lamps()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(PointLight, WithoutRadiusIsADelta) {
  const PointLight light{{0.0f, 3.0f, 4.0f}, 0.0f, Spectrum(50.0f)};
  const auto drawn = light.sample(k_floor, {0.5f, 0.5f});
  ASSERT_TRUE(drawn);
  EXPECT_TRUE(drawn->is_delta);
  EXPECT_FLOAT_EQ(drawn->distance, 5.0f);
  EXPECT_FLOAT_EQ(drawn->radiance.g, 2.0f);
  EXPECT_FALSE(light.sample({light.position, {0.0f, 0.0f, 1.0f}, true}, {0.5f, 0.5f}));
}

// Rendered by Blender 3.4.1: 30 degrees off the axis a spot without blend lights a plane below it
// by 0.5625 of what it does on the axis (cos^4: one of them is the spot's own).
TEST(SpotLight, FallsOffWithTheCosine) {
  const SpotLight light{
      {{0.0f, 0.0f, 1.0f}, 0.0f, Spectrum(1.0f)}, {0.0f, 0.0f, -1.0f}, 0.5f, 0.0f};
  const float offset = std::tan(k_pi / 6.0f);
  const auto at = [&](float x) {
    const auto drawn = light.sample({{x, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, true}, {0.5f, 0.5f});
    return drawn ? drawn->radiance.r * drawn->wi.z : 0.0f;
  };
  EXPECT_NEAR(at(offset) / at(0.0f), 0.5625f, 1e-5f);
  EXPECT_EQ(at(5.0f), 0.0f);
}

TEST(AreaLight, ShinesOnOneSideOnly) {
  const AreaLight light = area_light({0.0f, 0.0f, 1.0f}, 1.0f, false);
  EXPECT_FALSE(light.sample({{0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, -1.0f}, true}, {0.3f, 0.6f}));
  EXPECT_FALSE(light.intersect(Ray{{0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, -1.0f}}));
}

class EmissiveQuad : public ::testing::Test {
 protected:
  EmissiveQuad() {
    const float positions[] = {-1, -1, 2, 1, -1, 2, 1, 1, 2, -1, 1, 2, 5, 5, 2};
    const uint32_t corners[] = {0, 3, 2, 1, 0, 0, 4};
    const int32_t starts[] = {0, 4}, sizes[] = {4, 3};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 4, 5, 6};
    PolygonSoup soup;
    soup.positions = positions;
    soup.vertex_count = 5;
    soup.corner_vertices = corners;
    soup.corner_count = 7;
    soup.polygon_starts = starts;
    soup.polygon_sizes = sizes;
    soup.polygon_count = 2;
    soup.triangle_corners = triangles;
    soup.triangle_count = 3;
    mesh_ = build_mesh(soup);
    instance_.materials = instance_.behind_materials = {0};
  }
  Mesh mesh_;
  Instance instance_;
};

// The closed form of a square light of side 2 at distance 2 is that of side 1 at distance 1. The
// second polygon has no area and must never be drawn.
TEST_F(EmissiveQuad, IrradianceMatchesTheSquareAndPdfMatchesTheHit) {
  const MeshLight light(instance_, 0, mesh_, {1.0f});
  ASSERT_FALSE(light.empty());
  EXPECT_NEAR(light.power(), 4.0f, 1e-5f);
  Sampler sampler(3);
  double sum = 0.0;
  constexpr uint32_t k_samples = 1u << 14;
  for (uint32_t i = 0; i < k_samples; ++i) {
    sampler.start_sample(0, 0, i);
    const auto drawn = light.sample(k_floor, sampler.get_2d());
    ASSERT_TRUE(drawn);
    sum += drawn->wi.z / drawn->pdf;
    const SurfaceInteraction at =
        make_interaction(Ray{k_floor.position, drawn->wi}, drawn->hit, instance_, mesh_, 0.0f);
    EXPECT_NEAR(light.pdf(at, k_floor.position) / drawn->pdf, 1.0f, 1e-3f);
    EXPECT_NEAR(distance(at.position, drawn->wi * drawn->distance), 0.0f, 1e-4f);
  }
  EXPECT_NEAR(sum / k_samples, 0.7522747, 0.7522747 * 0.003);
}

TEST_F(EmissiveQuad, DarkSlotsGiveNoLight) {
  EXPECT_TRUE(MeshLight(instance_, 0, mesh_, {0.0f}).empty());
}

TEST(EnvironmentLight, PixelsAreWhereBlenderPutsThem) {
  EXPECT_NEAR(equirectangular_projection({1.0f, 0.0f, 0.0f}).x, 0.5f, 1e-6f);
  EXPECT_NEAR(equirectangular_projection({0.0f, 1.0f, 0.0f}).x, 0.25f, 1e-6f);
  EXPECT_NEAR(equirectangular_projection({0.0f, 0.0f, 1.0f}).y, 1.0f, 1e-6f);
  for (float x = 0.05f; x < 1.0f; x += 0.1f) {
    const Vec2 uv{x, 0.3f};
    const Vec2 back = equirectangular_projection(equirectangular_to_direction(uv));
    EXPECT_NEAR(back.x, uv.x, 1e-6f);
    EXPECT_NEAR(back.y, uv.y, 1e-6f);
  }
}

// L = 1 + a.d gives the irradiance pi + (2 pi / 3) a.n.
TEST(EnvironmentLightStatistics, LinearRadianceGivesTheKnownIrradiance) {
  const Vec3 a{0.3f, -0.2f, 0.5f};
  const auto radiance = [&](Vec3 d) { return Spectrum(1.0f + dot(a, d)); };
  const EnvironmentLight light(radiance, 256, 128);
  Sampler sampler(4);
  double sum = 0.0;
  constexpr uint32_t k_samples = 1u << 16;
  for (uint32_t i = 0; i < k_samples; ++i) {
    sampler.start_sample(0, 0, i);
    const auto drawn = light.sample(sampler.get_2d());
    if (!drawn) continue;
    EXPECT_NEAR(light.pdf(drawn->wi) / drawn->pdf, 1.0f, 1e-2f);
    sum += radiance(drawn->wi).r * std::max(drawn->wi.z, 0.0f) / drawn->pdf;
  }
  EXPECT_NEAR(sum / k_samples, k_pi + k_two_pi / 3.0f * a.z, 0.01);
}

// What an image shows between its pixels is what the map says there: f / pdf hardly varies.
TEST(EnvironmentLightStatistics, ASpotOfOnePixelIsSampledAsItIsShown) {
  constexpr int k_width = 64, k_height = 32;
  const auto radiance = [](Vec3 d) {
    const Vec2 uv = equirectangular_projection(d);
    const float x = std::abs(uv.x * k_width - 20.5f), y = std::abs(uv.y * k_height - 22.5f);
    return Spectrum(1e4f * std::max(1.0f - x, 0.0f) * std::max(1.0f - y, 0.0f));
  };
  const EnvironmentLight light(radiance, k_width, k_height);
  Sampler sampler(4);
  double sum = 0.0, sum_of_squares = 0.0;
  constexpr uint32_t k_samples = 1u << 12;
  for (uint32_t i = 0; i < k_samples; ++i) {
    sampler.start_sample(0, 0, i);
    const auto drawn = light.sample(sampler.get_2d());
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(light.pdf(drawn->wi) / drawn->pdf, 1.0f, 2e-2f);
    const double value = radiance(drawn->wi).r / drawn->pdf / k_samples;
    sum += value;
    sum_of_squares += value * value;
  }
  EXPECT_NEAR(sum, light.mean_radiance() * 4.0 * k_pi, 2e-3 * sum);
  EXPECT_LT(sum_of_squares * k_samples / (sum * sum) - 1.0, 0.01);
}

// To the poles, where the last half of a row is: uniform directions find all of the density.
TEST(EnvironmentLightStatistics, DensityCoversTheSphere) {
  for (const int height : {1, 4, 32}) {
    const auto radiance = [](Vec3 d) { return Spectrum(d.z > 0.7f ? 3.0f : 1.0f + d.x); };
    const EnvironmentLight light(radiance, 2 * height, height);
    Sampler sampler(9);
    double sum = 0.0;
    constexpr uint32_t k_samples = 1u << 16;
    for (uint32_t i = 0; i < k_samples; ++i) {
      sampler.start_sample(0, 0, i);
      sum += 4.0 * k_pi * light.pdf(warp_uniform_sphere(sampler.get_2d()));
    }
    EXPECT_NEAR(sum / k_samples, 1.0, 2e-3) << height;
    EXPECT_GT(light.pdf(normalize({1e-2f, 0.0f, 1.0f})), 0.0f);
  }
}

// Where it is dim surfaces look themselves, yet nothing that shines is out of reach.
TEST(EnvironmentLight, DimPartsKeepALittle) {
  const auto radiance = [](Vec3 d) { return Spectrum(d.x > 0.0f ? 3.0f : 0.5f); };
  const EnvironmentLight light(radiance, 64, 32);
  const float bright = light.pdf(normalize({1.0f, 0.3f, 0.2f}));
  const float dim = light.pdf(normalize({-1.0f, 0.3f, 0.2f}));
  EXPECT_GT(dim, 0.0f);
  EXPECT_LT(dim / bright, 0.5f * 0.5f / 3.0f);
}

// A sky of 1 with a sun of 2e4 that is half below a cell of the map: E = pi + L omega cos.
TEST(EnvironmentLightStatistics, SunInTheSkyIsSampledApart) {
  const SunDisk sun{normalize({0.3f, -0.4f, 0.8f}), 0.01f};
  const float solid_angle = k_two_pi * 2.0f * sqr(std::sin(0.5f * sun.half_angle));
  const auto radiance = [&](Vec3 d) {
    return Spectrum(length_squared(d - sun.direction) < sqr(sun.half_angle) ? 2e4f : 1.0f);
  };
  const EnvironmentLight light(radiance, 128, 64, sun);
  EXPECT_NEAR(light.mean_radiance(), 1.0f + 2e4f * solid_angle / (4.0f * k_pi), 0.01f);
  Sampler sampler(4);
  double sum = 0.0, sum_of_squares = 0.0, pdf_over_sphere = 0.0;
  constexpr uint32_t k_samples = 1u << 14;
  for (uint32_t i = 0; i < k_samples; ++i) {
    sampler.start_sample(0, 0, i);
    const auto drawn = light.sample(sampler.get_2d());
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(light.pdf(drawn->wi) / drawn->pdf, 1.0f, 2e-2f);
    const double value = radiance(drawn->wi).r * std::max(drawn->wi.z, 0.0f) / drawn->pdf;
    sum += value;
    sum_of_squares += value * value;
    const Vec3 anywhere = warp_uniform_sphere(sampler.get_2d());
    pdf_over_sphere += light.pdf(anywhere) * 4.0 * k_pi;
  }
  const double expected = k_pi + 2e4 * solid_angle * sun.direction.z;
  EXPECT_NEAR(sum / k_samples, expected, 0.01 * expected);
  // Both parts have their share: one alone would leave the variance of missing the other.
  EXPECT_LT(sum_of_squares / k_samples, 2.0 * expected * expected);
  // Uniform directions hardly meet the sun: what they see is the map's part.
  const double sun_share = 1.0 - pdf_over_sphere / k_samples;
  EXPECT_NEAR(sun_share, 2e4 * solid_angle / (4.0 * k_pi + 2e4 * solid_angle), 0.05);
}

TEST(LightSampler, ProbabilitiesSumToOneAndFollowTheChoice) {
  for (const size_t count : {size_t{5}, size_t{200}}) {
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i)
      lights[i].shape = PointLight{
          {static_cast<float>(i), 1.0f, 2.0f}, 0.1f, Spectrum(1.0f + static_cast<float>(i % 7))};
    lights[1].visibility = Visibility::from_sets(2u, 0x3fu);  // only in the first dream
    const LightSampler sampler(lights, 0);
    double total = 0.0;
    for (uint32_t i = 0; i < count; ++i)
      total += sampler.probability(k_floor, i);
    EXPECT_NEAR(total, 1.0, 1e-4);
    EXPECT_EQ(sampler.probability(k_floor, 1), 0.0f);
    for (float u = 0.0f; u < 1.0f; u += 0.013f) {
      const auto choice = sampler.choose(k_floor, u);
      ASSERT_TRUE(choice);
      EXPECT_NE(choice->light, 1u);
      EXPECT_NEAR(choice->probability, sampler.probability(k_floor, choice->light), 1e-5f);
    }
  }
}

// Every light as often among the candidates as `expected_count` says; and what is left of the
// number is even whatever it has drawn.
TEST(LightSampler, CandidatesComeAsOftenAsTheySay) {
  for (const size_t count : {size_t{1}, size_t{2}, size_t{6}, size_t{200}}) {
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i)
      lights[i].shape = PointLight{{static_cast<float>(i), 1.0f, 2.0f},
                                   0.1f,
                                   Spectrum(1.0f + 10.0f * static_cast<float>(i % 3))};
    const LightSampler sampler(lights, 0);
    constexpr int k_draws = 40000;
    std::vector<double> found(count);
    struct Left {
      double sum = 0.0;
      int draws = 0;
    };
    std::map<std::vector<uint32_t>, Left> left_of;
    for (int draw = 0; draw < k_draws; ++draw) {
      const float u = (static_cast<float>(draw) + 0.5f) / k_draws;
      const LightCandidates drawn = sampler.candidates(k_floor, u);
      std::vector<uint32_t> names;
      for (size_t i = 0; i < drawn.count; ++i) {
        const auto [light, expected] = drawn.lights[i];
        EXPECT_NEAR(expected, sampler.expected_count(k_floor, light), 1e-5f * expected);
        found[light] += 1.0;
        names.push_back(light);
      }
      Left& left = left_of[names];
      left.sum += static_cast<double>(drawn.fresh_u);
      ++left.draws;
    }
    for (uint32_t i = 0; i < count; ++i)
      EXPECT_NEAR(found[i] / k_draws, sampler.expected_count(k_floor, i), 2e-4) << i;
    if (!sampler.are_weighed()) continue;
    for (const auto& [names, left] : left_of)
      if (left.draws > 100) {
        EXPECT_NEAR(left.sum / left.draws, 0.5, 0.01) << names.size();
      }
  }
}

// A lamp that lights a point is always chosen now and then.
TEST(LightSampler, ImportanceIsPositiveWhereverALampShines) {
  Sampler sampler(5);
  for (const LampCase& c : lamps()) {
    for (uint32_t i = 0; i < 4000; ++i) {
      sampler.start_sample(0, 0, i);
      const Vec2 place = sampler.get_2d();
      const ShadingPoint point{
          {6.0f * place.x - 3.0f, 6.0f * place.y - 3.0f, sampler.get_1d() * 1.5f},
          warp_uniform_sphere(sampler.get_2d()),
          true};
      const auto drawn = sample_lamp(c.light, point, sampler.get_2d());
      if (!drawn || !(dot(drawn->wi, point.normal) > 0.0f)) continue;
      EXPECT_GT(light_importance(c.light, point), 0.0f) << c.name;
    }
  }
}

// In its beam a lamp of small spread outshines one of the same power without limit, as often as it
// is brighter; beside its beam it is not chosen.
TEST(LightSampler, FollowsTheBeamOfANarrowLamp) {
  std::vector<Light> lights(2);
  const AreaLight narrow = area_light({0.0f, 0.0f, 3.0f}, 0.1f, false, 0.7f);
  lights[0].shape = narrow;
  lights[1].shape = area_light({0.0f, 0.0f, 3.0f}, 0.1f, false);
  const LightSampler sampler(lights, 0);
  for (const float x : {0.0f, 0.4f, 0.8f, 5.0f}) {
    const ShadingPoint point{{x, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, true};
    std::array<double, 2> irradiance{};
    Sampler random(6);
    for (uint32_t i = 0; i < 4096; ++i) {
      random.start_sample(0, 0, i);
      const Vec2 u = random.get_2d();
      for (size_t k = 0; k < 2; ++k)
        if (const auto drawn = sample_lamp(lights[k], point, u))
          irradiance[k] += mean(drawn->radiance) * drawn->wi.z / drawn->pdf;
    }
    const double share = irradiance[0] / (irradiance[0] + irradiance[1]);
    EXPECT_NEAR(sampler.probability(point, 0), share, 0.05) << x;
  }
  EXPECT_EQ(sampler.probability({{5.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, true}, 0), 0.0f);
}

}  // namespace
}  // namespace tenniel
