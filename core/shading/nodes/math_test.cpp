// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/math.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "shading/nodes/vector.h"
#include "shading/surface_tangent.h"

namespace tenniel {
namespace {

using M = MathOperation;
using V = VectorOperation;

struct MathCase {
  M operation;
  float a, b, c, expected;
};

// Values worked out by hand.
class MathOperationTest : public testing::TestWithParam<MathCase> {};

TEST_P(MathOperationTest, GivesTheExpectedValue) {
  const MathCase& p = GetParam();
  EXPECT_NEAR(math_operation(p.operation, p.a, p.b, p.c), p.expected,
              2e-6f * std::max(1.0f, std::abs(p.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    All, MathOperationTest,
    testing::Values(
        MathCase{M::add, 1.5f, 2, 0, 3.5f}, MathCase{M::subtract, 1.5f, 2, 0, -0.5f},
        MathCase{M::multiply, 1.5f, 2, 0, 3}, MathCase{M::divide, 3, 2, 0, 1.5f},
        MathCase{M::divide, 3, 0, 0, 0}, MathCase{M::multiply_add, 2, 3, 4, 10},
        MathCase{M::power, 2, 0.5f, 0, 1.41421356f}, MathCase{M::power, -2, 3, 0, -8},
        MathCase{M::power, -2, 0.5f, 0, 0}, MathCase{M::power, 0, 0, 0, 1},
        MathCase{M::logarithm, 8, 2, 0, 3}, MathCase{M::logarithm, -1, 2, 0, 0},
        MathCase{M::logarithm, 8, 1, 0, 0}, MathCase{M::sqrt, 9, 0, 0, 3},
        MathCase{M::sqrt, -9, 0, 0, 0}, MathCase{M::inverse_sqrt, 4, 0, 0, 0.5f},
        MathCase{M::inverse_sqrt, 0, 0, 0, 0}, MathCase{M::absolute, -2, 0, 0, 2},
        MathCase{M::exponent, 1, 0, 0, 2.71828183f}, MathCase{M::minimum, 1, -2, 0, -2},
        MathCase{M::maximum, 1, -2, 0, 1}, MathCase{M::less_than, 1, 1, 0, 0},
        MathCase{M::less_than, 0, 1, 0, 1}, MathCase{M::greater_than, 2, 1, 0, 1},
        MathCase{M::sign, -3, 0, 0, -1}, MathCase{M::sign, 0, 0, 0, 0},
        MathCase{M::compare, 1, 1.2f, 0.25f, 1}, MathCase{M::compare, 1, 1.2f, 0.1f, 0},
        MathCase{M::smooth_min, 1, 1, 0.6f, 0.9f}, MathCase{M::smooth_min, 1, 5, 0.6f, 1},
        MathCase{M::smooth_max, 1, 1, 0.6f, 1.1f}, MathCase{M::smooth_min, 2, 1, 0, 1},
        MathCase{M::round, 2.5f, 0, 0, 3}, MathCase{M::round, -2.5f, 0, 0, -2},
        MathCase{M::floor, -0.5f, 0, 0, -1}, MathCase{M::ceil, -0.5f, 0, 0, 0},
        MathCase{M::trunc, -1.7f, 0, 0, -1}, MathCase{M::fract, -0.25f, 0, 0, 0.75f},
        MathCase{M::modulo, -5, 3, 0, -2}, MathCase{M::modulo, 5, 0, 0, 0},
        MathCase{M::wrap, 7, 1, 5, 3}, MathCase{M::wrap, 7, 2, 2, 2},
        MathCase{M::snap, 7.3f, 2, 0, 6}, MathCase{M::snap, 7.3f, 0, 0, 0},
        MathCase{M::pingpong, 3.5f, 1, 0, 0.5f}, MathCase{M::pingpong, 3.5f, 0, 0, 0},
        MathCase{M::sine, 1, 0, 0, 0.841470985f}, MathCase{M::cosine, 1, 0, 0, 0.540302306f},
        MathCase{M::tangent, 1, 0, 0, 1.55740772f}, MathCase{M::arcsine, 2, 0, 0, 1.57079633f},
        MathCase{M::arccosine, -2, 0, 0, 3.14159265f},
        MathCase{M::arctangent, 1, 0, 0, 0.785398163f}, MathCase{M::arctan2, 1, -1, 0, 2.35619449f},
        MathCase{M::sinh, 1, 0, 0, 1.17520119f}, MathCase{M::cosh, 1, 0, 0, 1.54308063f},
        MathCase{M::tanh, 1, 0, 0, 0.761594156f}, MathCase{M::radians, 180, 0, 0, 3.14159265f},
        MathCase{M::degrees, 3.14159265f, 0, 0, 180}));

TEST(Clamp, RangeSwapsItsBounds) {
  EXPECT_EQ(clamp_range(0.7f, 0.5f, 0.2f), 0.5f);
  EXPECT_EQ(clamp_minmax(0.7f, 0.5f, 0.2f), 0.2f);
  EXPECT_EQ(clamp_minmax(0.1f, 0.2f, 0.5f), 0.2f);
}

TEST(MapRange, Shapes) {
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::linear, 1.5f, 4), 1.5f);
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::stepped, 0.3f, 4), 0.25f);
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::stepped, 0.3f, 0), 0.0f);
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::smoothstep, 0.25f, 4), 0.15625f);
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::smootherstep, 0.25f, 4), 0.103515625f);
  EXPECT_FLOAT_EQ(shape_range(MapRangeShape::smoothstep, 7.0f, 4), 1.0f);
}

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, 1e-6f);
  EXPECT_NEAR(a.y, b.y, 1e-6f);
  EXPECT_NEAR(a.z, b.z, 1e-6f);
}

struct VectorCase {
  V operation;
  Vec3 expected;
};
const Vec3 k_a{1.0f, -2.0f, 2.5f}, k_b{0.0f, 2.0f, -1.0f}, k_c{0.5f, 0.0f, 3.0f};

class VectorOperationTest : public testing::TestWithParam<VectorCase> {};

TEST_P(VectorOperationTest, GivesTheExpectedVector) {
  expect_near(vector_operation(GetParam().operation, k_a, k_b, k_c, 1.5f), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    All, VectorOperationTest,
    testing::Values(VectorCase{V::add, {1, 0, 1.5f}}, VectorCase{V::subtract, {1, -4, 3.5f}},
                    VectorCase{V::multiply, {0, -4, -2.5f}}, VectorCase{V::divide, {0, -1, -2.5f}},
                    VectorCase{V::multiply_add, {0.5f, -4, 0.5f}},
                    VectorCase{V::cross_product, {-3, 1, 2}},
                    VectorCase{V::project, {0, -2.6f, 1.3f}},
                    VectorCase{V::reflect, {1, 3.2f, -0.1f}},
                    VectorCase{V::faceforward, k_a * 1.0f}, VectorCase{V::scale, {1.5f, -3, 3.75f}},
                    VectorCase{V::absolute, {1, 2, 2.5f}}, VectorCase{V::minimum, {0, -2, -1}},
                    VectorCase{V::maximum, {1, 2, 2.5f}}, VectorCase{V::floor, {1, -2, 2}},
                    VectorCase{V::ceil, {1, -2, 3}}, VectorCase{V::fraction, {0, 0, 0.5f}},
                    VectorCase{V::modulo, {0, 0, 0.5f}}, VectorCase{V::wrap, {0.5f, 0, 2.5f}},
                    VectorCase{V::snap, {0, -2, 3}},
                    VectorCase{V::sine, {0.841470985f, -0.909297427f, 0.598472144f}},
                    VectorCase{V::cosine, {0.540302306f, -0.416146837f, -0.801143616f}},
                    VectorCase{V::tangent, {1.55740772f, 2.18503986f, -0.747022297f}}));

TEST(VectorOperation, NormalizeOfZeroIsZero) {
  expect_near(vector_operation(V::normalize, {}, {}, {}, 1), {});
  EXPECT_NEAR(length(vector_operation(V::normalize, k_a, {}, {}, 1)), 1.0f, 1e-6f);
}

TEST(VectorOperation, RefractFollowsSnellAndReflectsToNothing) {
  const float sin_i = 0.6f;
  const Vec3 incident{sin_i, 0.0f, -0.8f}, normal{0.0f, 0.0f, 3.0f};
  const Vec3 refracted = vector_operation(V::refract, incident, normal, {}, 1.0f / 1.5f);
  EXPECT_NEAR(refracted.x, sin_i / 1.5f, 1e-6f);
  EXPECT_NEAR(length(refracted), 1.0f, 1e-6f);
  expect_near(vector_operation(V::refract, incident, normal, {}, 2.0f), {});
}

TEST(VectorOperation, Measures) {
  EXPECT_FLOAT_EQ(vector_measure(V::dot_product, k_a, k_b), -6.5f);
  EXPECT_FLOAT_EQ(vector_measure(V::length, {3, 4, 0}, k_b), 5.0f);
  EXPECT_FLOAT_EQ(vector_measure(V::distance, {3, 4, 0}, {3, 0, 3}), 5.0f);
  EXPECT_EQ(vector_measure(V::add, k_a, k_b), 0.0f);
}

TEST(Rotation, EulerIsXThenYThenZ) {
  const Vec3 angles{0.3f, -0.7f, 1.1f}, v{0.2f, 0.5f, -0.9f};
  const Vec3 x = rotate_about(v, {1, 0, 0}, angles.x);
  const Vec3 xy = rotate_about(x, {0, 1, 0}, angles.y);
  const Transform matrix = euler_rotation(angles);
  expect_near(matrix.vector(v), rotate_about(xy, {0, 0, 1}, angles.z));
  expect_near(transposed(matrix).vector(matrix.vector(v)), v);
}

}  // namespace
}  // namespace tenniel
