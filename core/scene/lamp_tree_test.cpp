// SPDX-License-Identifier: Apache-2.0
// What a lamp's tree reads of its lamp, as Blender 3.4.1 renders it.
#include <gtest/gtest.h>

#include "scene/compile_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// A lamp whose colour is an output of a node, and what it gives when seen along `wi`.
class LampTree {
 public:
  LampTree(const std::string& type, const std::string& node, const std::string& output,
           const Matrix34& matrix) {
    SceneBuilder b;
    GraphBuilder g("lamp", "ShaderNodeOutputLight");
    const uint32_t source = g.add(node);
    const uint32_t end = g.add("ShaderNodeEmission", {{"Strength", {1.0f}}});
    g.link(source, output, end, "Color");
    LightDesc& lamp = b.lamp(type, 10.0f, matrix);
    lamp.graph = g.surface(end, "Emission").build();
    lamp.shape = "RECTANGLE";
    lamp.size_x = 2.0f;
    lamp.size_y = 0.5f;
    lamp.random = 0.375f;
    Diagnostics diagnostics;
    scene_ = compile_scene(std::move(b.scene), diagnostics, {});
    context_.reserve(scene_->register_count);
  }
  Spectrum value(Vec3 position, Vec3 wi, float distance = 1.0f) {
    return lamp_emission(*scene_, scene_->lights.at(0), position, wi, distance, {}, context_);
  }

 private:
  std::shared_ptr<const Scene> scene_;
  ShadingContext context_;
};

void expect_near(Spectrum value, Vec3 expected) {
  EXPECT_NEAR(value.r, expected.x, 1e-5f);
  EXPECT_NEAR(value.g, expected.y, 1e-5f);
  EXPECT_NEAR(value.b, expected.z, 1e-5f);
}

constexpr Vec3 k_up{0.0f, 0.0f, 1.0f};

TEST(LampTree, ParametricRunsOverTheRectangleOfAnAreaLamp) {
  LampTree lamp("AREA", "ShaderNodeNewGeometry", "Parametric", turned(30.0f, 1.0f, 2.0f, 3.0f));
  const Transform matrix = Transform::from_rows(turned(30.0f, 1.0f, 2.0f, 3.0f));
  expect_near(lamp.value(matrix.point({0.0f, 0.0f, 0.0f}), k_up), {0.5f, 0.5f, 0.0f});
  expect_near(lamp.value(matrix.point({0.6f, 0.0f, 0.0f}), k_up), {0.8f, 0.5f, 0.0f});
  expect_near(lamp.value(matrix.point({0.0f, -0.2f, 0.0f}), k_up), {0.5f, 0.1f, 0.0f});
}

TEST(LampTree, ParametricOfAPointLampIsItsMapOfDirections) {
  LampTree lamp("POINT", "ShaderNodeNewGeometry", "Parametric", at(-0.4f, 0.5f, 2.0f));
  const Vec3 wi = normalize(Vec3{-0.7f, 0.3f, 2.0f});
  const Spectrum value = lamp.value({-0.4f, 0.5f, 2.0f}, wi, 2.1f);
  EXPECT_NEAR(value.r, 0.6982f, 1e-3f);
  EXPECT_NEAR(value.g, 0.1859f, 1e-3f);
}

TEST(LampTree, NormalIsWhereTheLampShines) {
  const Matrix34 matrix = turned(90.0f, 0.0f, 0.0f, 0.0f);
  const Vec3 wi = normalize(Vec3{0.3f, 0.4f, 1.0f});
  LampTree area("AREA", "ShaderNodeNewGeometry", "Normal", matrix);
  expect_near(area.value({}, wi), {0.0f, 1.0f, 0.0f});
  LampTree point("POINT", "ShaderNodeNewGeometry", "Normal", matrix);
  expect_near(point.value({}, wi), -wi);
  LampTree local("AREA", "ShaderNodeTexCoord", "Normal", matrix);
  expect_near(local.value({}, wi), {0.0f, 0.0f, -1.0f});
}

TEST(LampTree, ASunLiesInADirection) {
  LampTree sun("SUN", "ShaderNodeNewGeometry", "Position", k_identity34);
  expect_near(sun.value(k_up * 1e6f, k_up, k_infinity), -k_up);
}

TEST(LampTree, ObjectInfoKnowsTheRandomNumberOfTheLampAlone) {
  LampTree random("SPOT", "ShaderNodeObjectInfo", "Random", at(5.0f, 6.0f, 7.0f));
  expect_near(random.value({}, k_up), {0.375f, 0.375f, 0.375f});
  LampTree location("SPOT", "ShaderNodeObjectInfo", "Location", at(5.0f, 6.0f, 7.0f));
  expect_near(location.value({}, k_up), {});
}

}  // namespace
}  // namespace tenniel
