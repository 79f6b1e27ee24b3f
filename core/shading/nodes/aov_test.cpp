// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "shading/test_graph.h"

namespace tenniel {
namespace {

// What the AOVs of a material add to those of a sample: the number, then the colour.
std::array<float, 5> written(const std::string& text) {
  const TestMaterial m(text);
  EXPECT_TRUE(m.reports.empty());
  std::array<float, 5> aovs{};
  ShadingContext context;
  context.aovs = aovs.data();
  m.run(m.material.aovs, k_query_aov, context);
  return aovs;
}

TEST(AovOutput, WritesTheSocketThatItsPassIsOf) {
  const char* text = R"(
    n: ShaderNodeMath @operation=ADD Value=1.5 Value_001=0.25
    a: ShaderNodeOutputAOV @aov_name=number Value<n.Value Color=9,9,9,1
    b: ShaderNodeOutputAOV @aov_name=color Color=0.1,0.2,0.3,1 Value=7
    out: ShaderNodeOutputMaterial)";
  const std::array<float, 5> wanted{1.75f, 0.1f, 0.2f, 0.3f, 1.0f};
  EXPECT_EQ(written(text), wanted);
}

TEST(AovOutput, SeveralOfOneNameAddUp) {
  const char* text = R"(
    a: ShaderNodeOutputAOV @aov_name=number Value=2
    b: ShaderNodeOutputAOV @aov_name=number Value=2
    out: ShaderNodeOutputMaterial)";
  EXPECT_EQ(written(text)[0], 4.0f);
}

// Nothing of it is kept, nor reported.
TEST(AovOutput, WithoutAPassIsNotThere) {
  const TestMaterial m(R"(
    n: ShaderNodeUnheardOf
    a: ShaderNodeOutputAOV @aov_name=nobody Value<n.Value
    out: ShaderNodeOutputMaterial)");
  EXPECT_TRUE(m.material.aovs.empty());
  EXPECT_TRUE(m.reports.empty());
}

TEST(AovOutput, TakesNoPartInTheSurface) {
  const TestMaterial m(R"(
    a: ShaderNodeOutputAOV @aov_name=number Value=2
    d: ShaderNodeBsdfDiffuse
    out: ShaderNodeOutputMaterial Surface<d.BSDF)");
  EXPECT_EQ(m.material.surface.listing().find("AOV"), std::string::npos);
  EXPECT_EQ(m.material.transparency.listing().find("AOV"), std::string::npos);
}

TEST(AovOutput, CyclesAreCut) {
  const TestMaterial m(R"(
    x: ShaderNodeMath Value<y.Value
    y: ShaderNodeMath Value<x.Value
    a: ShaderNodeOutputAOV @aov_name=number Value<x.Value
    out: ShaderNodeOutputMaterial)");
  EXPECT_EQ(m.reports.size(), 1u);
  EXPECT_FALSE(m.material.aovs.empty());
}

}  // namespace
}  // namespace tenniel
