// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/fresnel.h"
#include "math/numeric.h"
#include "shading/nodes/layer_weight.h"
#include "shading/nodes/vector.h"

namespace tenniel {
namespace {

void expect_near(Vec3 a, Vec3 b, float tolerance = 2e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(MapVector, PointAndTextureAreInverse) {
  const Vec3 v{0.3f, -1.2f, 2.0f}, location{1.0f, 2.0f, 3.0f}, scale{2.0f, 0.5f, -1.5f};
  const Transform turn = euler_rotation({0.4f, -0.9f, 2.0f});
  const Vec3 mapped = map_vector(MappingType::point, v, location, turn, scale);
  expect_near(map_vector(MappingType::texture, mapped, location, turn, scale), v, 5e-6f);
  expect_near(map_vector(MappingType::vector, v, location, turn, scale) + location, mapped);
}

TEST(MapVector, NormalIsUnitAndZeroScaleIsHarmless) {
  const Vec3 n = map_vector(MappingType::normal, {1, 1, 0}, {9, 9, 9}, {}, {2, 1, 1});
  expect_near(n, Vec3{0.5f, 1.0f, 0.0f} / std::sqrt(1.25f));
  expect_near(map_vector(MappingType::texture, {1, 2, 3}, {}, {}, {0, 1, 1}), {0, 2, 3});
  expect_near(map_vector(MappingType::normal, {}, {}, {}, {0, 0, 0}), {});
}

TEST(TextureMapping, AppliesRowsAndBounds) {
  const Vec3 v{1.0f, 2.0f, 3.0f};
  expect_near(apply_texture_mapping({}, v), v);
  std::vector<float> mapping = {0, 1, 0, 10, 2, 0, 0, 0, 0, 0, -1, 0};
  expect_near(apply_texture_mapping(mapping, v), {12, 2, -3});
  mapping.insert(mapping.end(), {0, 0, 0, 5, 5, 5});
  expect_near(apply_texture_mapping(mapping, v), {5, 2, 0});
}

// Directions of section 4 of Blender's conventions: the centre of the picture is +X.
TEST(Equirectangular, LandmarksAndRoundTrip) {
  const auto at = [](Vec3 d) { return equirectangular_projection(d); };
  EXPECT_NEAR(at({1, 0, 0}).x, 0.5f, 1e-6f);
  EXPECT_NEAR(at({1, 0, 0}).y, 0.5f, 1e-6f);
  EXPECT_NEAR(at({0, 3, 0}).x, 0.25f, 1e-6f);
  EXPECT_NEAR(at({0, 0, 1}).y, 1.0f, 1e-6f);
  EXPECT_NEAR(at({0, 0, -2}).y, 0.0f, 1e-6f);
  EXPECT_EQ(at({}), (Vec2{}));
  for (int i = 0; i < 100; ++i) {
    const float a = 0.7f * static_cast<float>(i), z = 0.98f * std::cos(1.3f * a);
    const float r = std::sqrt(1.0f - z * z);
    const Vec3 d{r * std::cos(a), r * std::sin(a), z};
    const Vec2 uv = at(d);
    const float phi = (0.5f - uv.x) * k_two_pi, theta = (1.0f - uv.y) * k_pi;
    expect_near({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
                d);
  }
}

TEST(MirrorBall, CentreLooksBackAndForwardIsTheRim) {
  const Vec2 centre = mirror_ball_projection({0, -1, 0});
  EXPECT_NEAR(centre.x, 0.5f, 1e-6f);
  EXPECT_NEAR(centre.y, 0.5f, 1e-6f);
  const Vec2 up = mirror_ball_projection({0, 0, 1});
  EXPECT_NEAR(up.x, 0.5f, 1e-6f);
  EXPECT_NEAR(up.y, 0.5f + 0.5f * std::sqrt(0.5f), 1e-6f);
  const Vec2 rim = mirror_ball_projection({0.05f, 1.0f, 0.0f});
  EXPECT_NEAR(std::hypot(rim.x - 0.5f, rim.y - 0.5f), 0.5f, 2e-3f);
}

TEST(SphereAndTube, WrapAroundZ) {
  EXPECT_NEAR(sphere_projection({0.5f, 1.0f, 0.5f}).x, 0.5f, 1e-6f);
  EXPECT_NEAR(sphere_projection({1.0f, 0.5f, 0.5f}).x, 0.25f, 1e-6f);
  EXPECT_NEAR(sphere_projection({0.5f, 0.5f, 1.0f}).y, 1.0f, 1e-6f);
  EXPECT_EQ(sphere_projection({0.5f, 0.5f, 0.5f}), (Vec2{}));
  EXPECT_NEAR(tube_projection({1.0f, 0.5f, 0.75f}).x, 0.25f, 1e-6f);
  EXPECT_NEAR(tube_projection({1.0f, 0.5f, 0.75f}).y, 0.75f, 1e-6f);
  EXPECT_EQ(tube_projection({0.5f, 0.5f, 0.9f}), (Vec2{}));
}

TEST(BoxWeights, SumToOneAndAreContinuous) {
  for (const float blend : {0.0f, 0.2f, 0.6f, 1.0f}) {
    Vec3 last{};
    for (int i = 0; i <= 2000; ++i) {
      const float a = k_pi * static_cast<float>(i) / 2000.0f;
      const Vec3 n{std::cos(a), std::sin(a) * 0.8f, std::sin(a) * 0.6f * std::cos(3.0f * a)};
      const Vec3 w = box_weights(n, blend);
      EXPECT_NEAR(w.x + w.y + w.z, 1.0f, 1e-5f);
      if (i > 0 && blend >= 0.2f) {
        EXPECT_NEAR(length(w - last), 0.0f, 0.05f) << blend << " " << i;
      }
      last = w;
    }
  }
  expect_near(box_weights({0, 0, -5}, 0.3f), {0, 0, 1});
  expect_near(box_weights({1, 1, 0}, 0.5f), {0.5f, 0.5f, 0});
}

TEST(BoxProjection, IsNotMirroredFromEitherSide) {
  const Vec3 p{0.2f, 0.3f, 0.6f};
  EXPECT_EQ(box_projection(p, {1, 0, 0}, 0), (Vec2{0.3f, 0.6f}));
  EXPECT_EQ(box_projection(p, {-1, 0, 0}, 0), (Vec2{0.7f, 0.6f}));
  EXPECT_EQ(box_projection(p, {0, -1, 0}, 1), (Vec2{0.2f, 0.6f}));
  EXPECT_EQ(box_projection(p, {0, 1, 0}, 1), (Vec2{0.8f, 0.6f}));
  EXPECT_EQ(box_projection(p, {0, 0, -1}, 2), (Vec2{0.3f, 0.2f}));
  EXPECT_EQ(box_projection(p, {0, 0, 1}, 2), (Vec2{0.7f, 0.2f}));
}

TEST(LayerWeight, FacingAndFresnel) {
  EXPECT_FLOAT_EQ(layer_facing(0.25f, 0.5f), 0.75f);
  EXPECT_FLOAT_EQ(layer_facing(-0.25f, 0.25f), 0.5f);
  EXPECT_FLOAT_EQ(layer_facing(0.5f, 0.75f), 0.75f);
  EXPECT_TRUE(std::isfinite(layer_facing(0.5f, 1.0f)));
  EXPECT_NEAR(layer_fresnel(1.0f, 0.5f, false), 1.0f / 9.0f, 1e-6f);
  EXPECT_NEAR(layer_fresnel(0.7f, 0.3f, false), fresnel_dielectric(0.7f, 1.0f / 0.7f), 1e-6f);
  EXPECT_NEAR(layer_fresnel(0.7f, 0.3f, true), fresnel_dielectric(0.7f, 0.7f), 1e-6f);
}

}  // namespace
}  // namespace tenniel
