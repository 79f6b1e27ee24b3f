// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "math/numeric.h"
#include "shading/nodes/cell_hash.h"
#include "shading/nodes/noise.h"
#include "shading/nodes/patterns.h"
#include "shading/nodes/voronoi.h"

namespace tenniel {
namespace {

// Where Cycles 3.4.1 was asked: its first sample of a pixel lies 1/2048 of a pixel off the centre.
constexpr size_t k_points = 3;
constexpr float k_shift = 0.00012207f;
const Vec3 k_at[k_points] = {{9.425f + k_shift, -5.575f + k_shift, 0.37f},
                             {10.675f + k_shift, -5.075f + k_shift, 0.37f},
                             {10.175f + k_shift, -3.825f + k_shift, 0.37f}};
constexpr float k_tolerance = 5e-5f;

NoisePoint<3> scaled3(Vec3 p, float s) {
  return {p.x * s, p.y * s, p.z * s};
}
NoisePoint<2> scaled2(Vec3 p, float s) {
  return {p.x * s, p.y * s};
}

TEST(CyclesOracle, Noise3d) {
  const float expected[k_points][3] = {{0.516422f, 0.530858f, 0.409238f},
                                       {0.69834f, 0.570643f, 0.394644f},
                                       {0.59307f, 0.423488f, 0.461571f}};
  for (size_t i = 0; i < k_points; ++i) {
    const auto rgb = noise_texture(scaled3(k_at[i], 3.1f), 2.5f, 0.6f, 0.4f, true);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(rgb[c], expected[i][c], k_tolerance);
  }
}

TEST(CyclesOracle, Noise2d) {
  const float expected[k_points][3] = {{0.516698f, 0.491606f, 0.395824f},
                                       {0.536751f, 0.711141f, 0.441708f},
                                       {0.588398f, 0.34318f, 0.590092f}};
  for (size_t i = 0; i < k_points; ++i) {
    const auto rgb = noise_texture(scaled2(k_at[i], 3.1f), 2.5f, 0.6f, 0.4f, true);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(rgb[c], expected[i][c], k_tolerance);
  }
}

TEST(CyclesOracle, Voronoi) {
  const float distance[] = {0.142467f, 0.180857f, 0.857171f};
  const float smooth[] = {0.142467f, 0.180857f, 0.750287f};
  const float edge[] = {0.223772f, 0.258971f, 0.022936f};
  const Spectrum color[] = {{0.773763f, 0.259194f, 0.917754f},
                            {0.707933f, 0.380983f, 0.774801f},
                            {0.493732f, 0.040338f, 0.009017f}};
  VoronoiParameters v;
  v.smoothness = 0.7f;
  for (size_t i = 0; i < k_points; ++i) {
    const NoisePoint<3> p = scaled3(k_at[i], 2.3f);
    const auto f1 = voronoi(VoronoiFeature::f1, p, v);
    EXPECT_NEAR(f1.distance, distance[i], k_tolerance);
    EXPECT_NEAR(f1.color.r, color[i].r, k_tolerance);
    EXPECT_NEAR(f1.color.g, color[i].g, k_tolerance);
    EXPECT_NEAR(f1.color.b, color[i].b, k_tolerance);
    EXPECT_NEAR(voronoi(VoronoiFeature::smooth_f1, p, v).distance, smooth[i], k_tolerance);
    EXPECT_NEAR(voronoi_edge_distance(p, v), edge[i], k_tolerance);
  }
}

TEST(CyclesOracle, Musgrave) {
  const float hybrid[] = {0.467685f, 0.268999f, 0.266574f};
  const float fbm[] = {0.143555f, 0.004178f, -0.126669f};
  MusgraveParameters m{MusgraveType::hybrid_multifractal, 3.5f, 1.2f, 2.1f, 0.3f, 1.4f};
  for (size_t i = 0; i < k_points; ++i) {
    m.type = MusgraveType::hybrid_multifractal;
    EXPECT_NEAR(musgrave(scaled3(k_at[i], 2.3f), m), hybrid[i], k_tolerance);
    m.type = MusgraveType::fbm;
    EXPECT_NEAR(musgrave(scaled3(k_at[i], 2.3f), m), fbm[i], k_tolerance);
  }
}

TEST(CyclesOracle, Wave) {
  const float expected[] = {0.027852f, 0.85159f, 0.028622f};
  WaveParameters w;
  w.distortion = 2.2f;
  w.detail = 1.5f;
  w.detail_scale = 1.3f;
  w.detail_roughness = 0.4f;
  for (size_t i = 0; i < k_points; ++i)
    EXPECT_NEAR(wave(k_at[i] * 1.7f, w), expected[i], k_tolerance);
}

TEST(CyclesOracle, Magic) {
  const Spectrum expected[] = {{0.045269f, 0.026272f, 0.260753f},
                               {0.548134f, 0.9946f, 0.548042f},
                               {0.319552f, 0.14513f, 0.882568f}};
  for (size_t i = 0; i < k_points; ++i) {
    const Spectrum c = magic(k_at[i], 1.3f, 5, 1.7f);
    EXPECT_NEAR(c.r, expected[i].r, 2e-4f);
    EXPECT_NEAR(c.g, expected[i].g, 2e-4f);
    EXPECT_NEAR(c.b, expected[i].b, 2e-4f);
  }
}

TEST(CyclesOracle, BrickAndChecker) {
  const float bricks[] = {0.685997f, 0.211502f, 0.720595f};
  const float squares[] = {1.0f, 0.0f, 1.0f};
  for (size_t i = 0; i < k_points; ++i) {
    const BrickSample sample = brick(k_at[i] * 3.0f, {});
    const float face = lerp(0.8f, 0.2f, sample.tint);
    EXPECT_NEAR(lerp(face, 0.0f, sample.mortar), bricks[i], k_tolerance);
    EXPECT_EQ(checker(k_at[i] * 4.0f), squares[i]);
  }
}

TEST(Checker, ChangesAtWholeNumbersAlsoBelowZero) {
  EXPECT_EQ(checker({0.5f, 0.5f, 0.5f}), 0.0f);
  for (int axis = 0; axis < 3; ++axis)
    for (const float x : {-2.5f, -1.5f, -0.5f, 0.5f, 1.5f}) {
      Vec3 here{0.5f, 0.5f, 0.5f}, next = here;
      here[axis] = x;
      next[axis] = x + 1.0f;
      EXPECT_NE(checker(here), checker(next)) << axis << " " << x;
    }
  // Blender's nudge puts each border into the cell on the side of zero.
  EXPECT_EQ(checker({1.0f, 0.5f, 0.5f}), checker({0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(checker({-1.0f, 0.5f, 0.5f}), checker({-0.5f, 0.5f, 0.5f}));
}

TEST(Checker, CoversHalfOfASphere) {
  int filled = 0;
  constexpr int k_steps = 400;
  for (int i = 0; i < k_steps; ++i)
    for (int j = 0; j < k_steps; ++j) {
      const float z = 2.0f * (static_cast<float>(i) + 0.5f) / k_steps - 1.0f;
      const float phi = k_two_pi * (static_cast<float>(j) + 0.5f) / k_steps;
      const float r = std::sqrt(1.0f - z * z);
      filled += checker(Vec3{r * std::cos(phi), r * std::sin(phi), z} * 7.0f) > 0.0f;
    }
  EXPECT_NEAR(static_cast<float>(filled) / (k_steps * k_steps), 0.5f, 2e-3f);
}

TEST(Gradient, KnownValues) {
  const Vec3 p{0.25f, 0.5f, 0.0f};
  const float r = 0.999999f - length(p);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::linear, p), 0.25f);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::quadratic, p), 0.0625f);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::easing, p), 0.15625f);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::diagonal, p), 0.375f);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::spherical, p), r);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::quadratic_sphere, p), r * r);
  EXPECT_FLOAT_EQ(gradient_pattern(GradientType::radial, {0.0f, 2.0f, 0.0f}), 0.75f);
  EXPECT_EQ(gradient_pattern(GradientType::linear, {-3.0f, 0.0f, 0.0f}), 0.0f);
}

template <size_t n>
NoisePoint<n> diagonal(float x) {
  NoisePoint<n> p;
  for (size_t i = 0; i < n; ++i)
    p[i] = x * (1.0f + 0.37f * static_cast<float>(i));
  return p;
}

template <size_t n>
void check_noise() {
  EXPECT_EQ(signed_noise(NoisePoint<n>{}), 0.0f);
  double sum = 0.0, squares = 0.0;
  constexpr int k_count = 20000;
  for (int i = 0; i < k_count; ++i) {
    const float x = 0.173f * static_cast<float>(i) - 1000.0f;
    const float value = signed_noise(diagonal<n>(x));
    EXPECT_LE(std::abs(value), 1.05f);
    EXPECT_NEAR(signed_noise(diagonal<n>(x + 1e-3f)), value, 2e-2f);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / k_count, 0.0, 0.02);
  EXPECT_GT(squares / k_count, 0.01);
}

TEST(Noise, IsContinuousBoundedAndCentred) {
  check_noise<1>();
  check_noise<2>();
  check_noise<3>();
  check_noise<4>();
}

TEST(Noise, SurvivesWhatIsNoCoordinate) {
  const float bad[] = {1e30f, -1e30f, std::numeric_limits<float>::infinity(), std::nanf("")};
  for (const float x : bad) {
    EXPECT_TRUE(std::isfinite(signed_noise(NoisePoint<3>{x, 0.5f, x})));
    EXPECT_TRUE(std::isfinite(fractal_noise(NoisePoint<3>{x, 0.5f, x}, 9.5f, 0.5f)));
    EXPECT_TRUE(std::isfinite(checker({x, x, x})));
    EXPECT_NO_FATAL_FAILURE(brick({x, x, x}, {}));
    EXPECT_NO_FATAL_FAILURE(voronoi(VoronoiFeature::f1, NoisePoint<2>{x, 1.0f}, {}));
  }
}

TEST(Noise, WholeDetailAgreesWithItsLimit) {
  const NoisePoint<3> p = {0.3f, 1.7f, -2.2f};
  EXPECT_NEAR(fractal_noise(p, 2.9999f, 0.5f), fractal_noise(p, 3.0f, 0.5f), 1e-4f);
}

template <size_t n>
void check_octaves(const NoisePoint<n>& p) {
  float sum = 0.0f, amplitude = 1.0f, amplitudes = 0.0f;
  NoisePoint<n> at = p;
  for (int octave = 0; octave < 16; ++octave) {
    sum += amplitude * unit_noise(at);
    amplitudes += amplitude;
    EXPECT_NEAR(fractal_noise(p, static_cast<float>(octave), 0.7f), sum / amplitudes, 1e-5f);
    amplitude *= 0.7f;
    for (float& x : at)
      x *= 2.0f;
  }
}

TEST(Noise, AddsAnyNumberOfOctaves) {
  check_octaves<1>({-7.3f});
  check_octaves<2>({1.9f, -0.4f});
  check_octaves<3>({0.3f, 1.7f, -2.2f});
  check_octaves<4>({0.3f, 1.7f, -2.2f, 12.6f});
}

// All distances from `p` to the points of the cells around its own, in order.
template <size_t n>
std::vector<float> sorted_distances(const NoisePoint<n>& p) {
  size_t cells = 1;
  for (size_t axis = 0; axis < n; ++axis)
    cells *= 3;
  std::vector<float> all;
  for (size_t i = 0; i < cells; ++i) {
    NoisePoint<n> cell;
    size_t rest = i;
    for (size_t axis = 0; axis < n; ++axis, rest /= 3)
      cell[axis] = std::floor(p[axis]) + static_cast<float>(rest % 3) - 1.0f;
    const NoisePoint<n> point = random_point_of(cell);
    float squares = 0.0f;
    for (size_t axis = 0; axis < n; ++axis)
      squares += sqr(cell[axis] + point[axis] - p[axis]);
    all.push_back(std::sqrt(squares));
  }
  std::sort(all.begin(), all.end());
  return all;
}

template <size_t n>
void check_nearest_points() {
  for (int i = 0; i < 200; ++i) {
    const NoisePoint<n> p = diagonal<n>(0.31f * static_cast<float>(i) - 40.0f);
    const std::vector<float> expected = sorted_distances(p);
    const VoronoiResult<n> nearest = voronoi(VoronoiFeature::f1, p, {});
    EXPECT_NEAR(nearest.distance, expected[0], 1e-4f);
    EXPECT_NEAR(voronoi(VoronoiFeature::f2, p, {}).distance, expected[1], 1e-4f);
    float squares = 0.0f;
    for (size_t axis = 0; axis < n; ++axis)
      squares += sqr(nearest.position[axis] - p[axis]);
    EXPECT_NEAR(std::sqrt(squares), expected[0], 1e-4f);
  }
}

TEST(Voronoi, FindsTheNearestOfAllPoints) {
  check_nearest_points<1>();
  check_nearest_points<2>();
  check_nearest_points<3>();
  check_nearest_points<4>();
}

TEST(Voronoi, IsFarFromEverythingWhereThereIsNoCoordinate) {
  const NoisePoint<2> nowhere = {std::nanf(""), 1.0f};
  EXPECT_EQ(voronoi(VoronoiFeature::f1, nowhere, {}).distance, 8.0f);
  EXPECT_EQ(voronoi_edge_distance(nowhere, {}), 8.0f);
}

TEST(Voronoi, WithoutRandomnessIsAGrid) {
  VoronoiParameters v;
  v.randomness = 0.0f;
  const NoisePoint<2> p = {3.25f, -1.5f};
  EXPECT_FLOAT_EQ(voronoi(VoronoiFeature::f1, p, v).distance, std::hypot(0.25f, 0.5f));
  EXPECT_FLOAT_EQ(voronoi(VoronoiFeature::f1, p, v).position[0], 3.0f);
  EXPECT_FLOAT_EQ(voronoi_edge_distance(NoisePoint<2>{3.3f, -1.9f}, v), 0.2f);
  EXPECT_FLOAT_EQ(voronoi_sphere_radius(p, v), 0.5f);
  v.metric = VoronoiMetric::manhattan;
  EXPECT_FLOAT_EQ(voronoi(VoronoiFeature::f1, NoisePoint<2>{3.25f, -1.9f}, v).distance, 0.35f);
  v.metric = VoronoiMetric::chebychev;
  EXPECT_FLOAT_EQ(voronoi(VoronoiFeature::f1, NoisePoint<2>{3.25f, -1.9f}, v).distance, 0.25f);
  v.metric = VoronoiMetric::minkowski;
  v.exponent = 2.0f;
  EXPECT_NEAR(voronoi(VoronoiFeature::f1, p, v).distance, std::hypot(0.25f, 0.5f), 1e-6f);
}

TEST(Voronoi, FeaturesAreOrdered) {
  for (int i = 0; i < 500; ++i) {
    const NoisePoint<4> p = diagonal<4>(0.31f * static_cast<float>(i) - 40.0f);
    VoronoiParameters v;
    const float f1 = voronoi(VoronoiFeature::f1, p, v).distance;
    EXPECT_LE(f1, voronoi(VoronoiFeature::f2, p, v).distance);
    EXPECT_LE(voronoi(VoronoiFeature::smooth_f1, p, v).distance, f1 + 1e-5f);
    v.smoothness = 0.0f;
    EXPECT_EQ(voronoi(VoronoiFeature::smooth_f1, p, v).distance, f1);
  }
}

TEST(CellHash, ChannelsAreIndependentNumbersInRange) {
  const Spectrum c = random_color_of(NoisePoint<4>{1.5f, 2.0f, -3.0f, 4.0f});
  EXPECT_NE(c.r, c.g);
  EXPECT_NE(c.g, c.b);
  for (const float v : {c.r, c.g, c.b})
    EXPECT_TRUE(v >= 0.0f && v <= 1.0f);
  EXPECT_EQ(random_of(NoisePoint<2>{1.5f, 2.0f}), random_point_of(NoisePoint<2>{1.5f, 2.0f})[0]);
}

}  // namespace
}  // namespace tenniel
