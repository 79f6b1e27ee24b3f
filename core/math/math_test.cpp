// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "math/bounds.h"
#include "math/frame.h"
#include "math/hash.h"
#include "math/numeric.h"
#include "math/ray.h"
#include "math/spectrum.h"
#include "math/transform.h"

namespace tenniel {
namespace {

// Values of Blender's own hash, rendered by Cycles 3.4.
TEST(Hash, AgreesWithBlender) {
  EXPECT_EQ(hash_uint(0u), 0x9519dc65u);
  EXPECT_EQ(hash_uint(1u), 0x4ad7c6a0u);
  EXPECT_EQ(hash_uint(1u, 2u), 0x1037cb9du);
  EXPECT_EQ(hash_uint(1u, 2u, 3u), 0xb8d17a0au);
  EXPECT_EQ(hash_uint(1u, 2u, 3u, 4u), 0x0584dec1u);
  EXPECT_FLOAT_EQ(hash_float(0.0f), 0.5824258563999147f);
  EXPECT_FLOAT_EQ(hash_float(1.0f, 2.0f), 0.54048234399885f);
  EXPECT_FLOAT_EQ(hash_float(1.0f, 2.0f, 3.0f), 0.29459814641033255f);
  EXPECT_FLOAT_EQ(hash_float(1.0f, 2.0f, 3.0f, 4.0f), 0.08476897610462479f);
}

TEST(Numeric, FastAnglesAreThoseOfTheLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const double turns = i / 1000.0, angle = turns * 2.0 * 3.14159265358979323846;
    const CosSin fast = cos_sin_of_turns(static_cast<float>(turns));
    // The number itself is rounded, the more the further out.
    const double tolerance = 2e-7 + 4e-7 * std::abs(turns);
    EXPECT_NEAR(fast.cos, std::cos(angle), tolerance) << turns;
    EXPECT_NEAR(fast.sin, std::sin(angle), tolerance) << turns;
    for (const float radius : {1e-20f, 1.0f, 3e18f}) {
      const float x = radius * static_cast<float>(std::cos(angle));
      const float y = radius * static_cast<float>(std::sin(angle));
      EXPECT_NEAR(fast_atan2(y, x), std::atan2(y, x), 4e-7) << turns;
    }
  }
  EXPECT_EQ(fast_atan2(0.0f, 0.0f), 0.0f);
  EXPECT_FLOAT_EQ(fast_atan2(0.0f, -1.0f), k_pi);
  EXPECT_FLOAT_EQ(fast_atan2(-0.0f, -1.0f), -k_pi);
}

TEST(Transform, InverseUndoesShearScaleAndTranslation) {
  const Transform t{
      {2.0f, 0.3f, 0.0f}, {-0.5f, -3.0f, 0.1f}, {0.2f, 0.0f, 0.7f}, {5.0f, -6.0f, 7.0f}};
  const Vec3 p{1.5f, -2.0f, 0.25f};
  EXPECT_NEAR(distance(t.inverse().point(t.point(p)), p), 0.0f, 1e-5f);
}

TEST(Transform, InverseOfASingularMapIsZero) {
  const Transform flat{
      {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 3.0f}};
  EXPECT_EQ(flat.inverse().point({9.0f, 9.0f, 9.0f}), Vec3());
}

TEST(Transform, NormalsStayPerpendicularUnderNonUniformScale) {
  const Transform t{{4.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.5f}, {}};
  const Vec3 tangent{1.0f, 1.0f, 0.0f}, normal{1.0f, -1.0f, 0.0f};
  const Vec3 world_normal = t.inverse().transposed_vector(normal);
  EXPECT_NEAR(dot(t.vector(tangent), world_normal), 0.0f, 1e-6f);
}

TEST(Frame, IsOrthonormalAndRightHandedInEveryDirection) {
  for (float theta = 0.0f; theta <= k_pi; theta += 0.1f) {
    for (float phi = 0.0f; phi < k_two_pi; phi += 0.37f) {
      const Vec3 n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta)};
      const Frame f = Frame::from_normal(n);
      EXPECT_NEAR(dot(f.x, f.y), 0.0f, 1e-5f);
      EXPECT_NEAR(length(f.x), 1.0f, 1e-5f);
      EXPECT_NEAR(distance(cross(f.x, f.y), n), 0.0f, 1e-5f);
      EXPECT_NEAR(distance(f.to_world(f.to_local({1.0f, 2.0f, 3.0f})), Vec3{1.0f, 2.0f, 3.0f}),
                  0.0f, 1e-4f);
    }
  }
}

TEST(Frame, TangentParallelToNormalStillGivesABasis) {
  const Frame f = Frame::from_normal_tangent({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 2.0f});
  EXPECT_NEAR(length(f.x), 1.0f, 1e-6f);
  EXPECT_NEAR(dot(f.x, f.z), 0.0f, 1e-6f);
}

TEST(Bounds, GrowsAndIgnoresEmptyBoxes) {
  Bounds3 b;
  EXPECT_TRUE(b.is_empty());
  EXPECT_EQ(b.radius(), 0.0f);
  b.add(Vec3{1.0f, 2.0f, 3.0f});
  b.add(Bounds3());
  b.add(Vec3{-1.0f, 2.0f, 3.0f});
  EXPECT_FLOAT_EQ(b.radius(), 1.0f);
  EXPECT_EQ(b.center(), (Vec3{0.0f, 2.0f, 3.0f}));
}

TEST(Spectrum, LuminanceOfWhiteIsOne) {
  EXPECT_NEAR(luminance(Spectrum(1.0f)), 1.0f, 1e-6f);
  EXPECT_FALSE(is_finite(Spectrum(0.0f, INFINITY, 0.0f)));
}

}  // namespace
}  // namespace tenniel
