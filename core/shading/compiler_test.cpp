// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "shading/nodes/register.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

int probe_runs = 0;

// A value that depends on the point; counts how often it is asked.
struct ProbeNode {
  Output<float> value;
  void eval(ShadingContext& context) const {
    ++probe_runs;
    context.set(value, context.surface.position.x);
  }
};

struct PositionNode {
  Output<Vec3> position;
  void eval(ShadingContext& context) const { context.set(position, context.surface.position); }
};

struct HalfNode {
  Input<float> value{0.25f};
  Output<float> half;
  void eval(ShadingContext& context) const { context.set(half, 0.5f * context.get(value)); }
};

struct LengthNode {
  Input<Vec3> vector;
  Output<float> length;
  void eval(ShadingContext& context) const {
    context.set(length, tenniel::length(context.get(vector)));
  }
};

// Stands in for Texture Coordinate, so that the tests do not depend on it.
struct CoordinateNode {
  Output<Vec3> generated, uv;
  void eval(ShadingContext& context) const {
    context.set(generated, context.surface.position);
    context.set(uv, Vec3{0.25f, 0.75f, 0.0f});
  }
};

struct PatternNode {
  Input<Vec3> vector;
  Output<Spectrum> color;
  void eval(ShadingContext& context) const {
    const Vec3 v = context.get(vector);
    context.set(color, Spectrum(v.x, v.y, v.z));
  }
};

const NodeRegistry& test_registry() {
  static const NodeRegistry registry = [] {
    NodeRegistry r;
    register_closure_nodes(r);
    register_principled_nodes(r);
    register_bump_nodes(r);
    register_output_nodes(r);
    r.add<ProbeNode>("Probe").output("Value", &ProbeNode::value).varying();
    r.add<PositionNode>("Position").output("Position", &PositionNode::position).varying();
    r.add<HalfNode>("Half").input("Value", &HalfNode::value).output("Half", &HalfNode::half);
    r.add<LengthNode>("Length")
        .input("Vector", &LengthNode::vector)
        .output("Length", &LengthNode::length);
    r.add<CoordinateNode>("ShaderNodeTexCoord")
        .output("Generated", &CoordinateNode::generated)
        .output("UV", &CoordinateNode::uv)
        .varying();
    r.add<PatternNode>("Pattern")
        .input("Vector", &PatternNode::vector)
        .implicit(ImplicitInput::uv)
        .output("Color", &PatternNode::color);
    return r;
  }();
  return registry;
}

TestMaterial compiled(const std::string& text, bool optimise = true) {
  return TestMaterial(text, optimise, &test_registry());
}

ShadingContext context_at(Vec3 position) {
  ShadingContext context;
  context.surface.position = position;
  context.surface.wo = context.surface.geometric_normal =
      context.surface.shading_normal = {0, 0, 1};
  return context;
}

TEST(Compiler, ListsALinkedGraph) {
  const auto m = compiled(R"(
    probe: Probe
    half: Half Value<probe.Value
    emit: ShaderNodeEmission Strength<half.Half
    out: ShaderNodeOutputMaterial Surface<emit.Emission)");
  EXPECT_EQ(m.material.surface.listing(),
            "r0 = Probe()\n"
            "r1 = Half(r0)\n"
            "ShaderNodeEmission((1, 1, 1), r1; weight 1)\n");
  EXPECT_TRUE(m.reports.empty());
  EXPECT_TRUE(m.material.emits);
  EXPECT_FALSE(m.material.scatters);
  EXPECT_FALSE(m.material.is_emission_constant);
}

TEST(Compiler, ReusesRegistersOfDeadValues) {
  const auto m = compiled(R"(
    probe: Probe
    a: Half Value<probe.Value
    b: Half Value<a.Half
    c: Half Value<b.Half
    emit: ShaderNodeEmission Strength<c.Half
    out: ShaderNodeOutputMaterial Surface<emit.Emission)");
  EXPECT_EQ(m.material.surface.register_count(), 2u);
}

TEST(Compiler, FoldsConstantsByEval) {
  const auto m = compiled(R"(
    a: Half Value=3
    b: Half Value<a.Half
    emit: ShaderNodeEmission Color=1,0.5,0.25 Strength<b.Half
    out: ShaderNodeOutputMaterial Surface<emit.Emission)");
  EXPECT_EQ(m.material.surface.listing(), "ShaderNodeEmission((1, 0.5, 0.25), 0.75; weight 1)\n");
  EXPECT_TRUE(m.material.is_emission_constant);
  EXPECT_EQ(m.material.constant_emission, Spectrum(0.75f, 0.375f, 0.1875f));
}

TEST(Compiler, KeepsAConstantNormalApartFromTheImpliedOne) {
  const auto m = compiled(R"(
    half: Half Value=2
    matte: ShaderNodeBsdfDiffuse Normal<half.Half
    out: ShaderNodeOutputMaterial Surface<matte.BSDF)");
  ShadingContext context = context_at({0, 0, 0});
  context.reserve(m.material.surface.register_count());
  context.begin(k_query_surface);
  m.material.surface.run(context);
  context.bsdf.finish();
  // (1, 1, 1) / sqrt(3), raised a little for the mirror direction; the implied one is (0, 0, 1).
  EXPECT_NEAR(context.bsdf.average_normal().x, 0.55f, 0.06f);
}

TEST(Compiler, SharesEqualNodes) {
  const auto m = compiled(R"(
    p: Probe
    q: Probe
    a: Half Value<p.Value
    b: Half Value<q.Value
    e: ShaderNodeEmission Strength<a.Half
    f: ShaderNodeEmission Strength<b.Half
    add: ShaderNodeAddShader Shader<e.Emission Shader_001<f.Emission
    out: ShaderNodeOutputMaterial Surface<add.Shader)");
  EXPECT_EQ(m.material.surface.listing(),
            "r0 = Probe()\n"
            "r1 = Half(r0)\n"
            "ShaderNodeEmission((1, 1, 1), r1; weight 1)\n"
            "ShaderNodeEmission((1, 1, 1), r1; weight 1)\n");
}

TEST(Compiler, ConvertsAsBlenderDoes) {
  const auto m = compiled(R"(
    p: Position
    to_color: ShaderNodeEmission Color<p.Position
    to_number: ShaderNodeEmission Color=1,0,0 Strength<p.Position
    add: ShaderNodeAddShader Shader<to_color.Emission Shader_001<to_number.Emission
    out: ShaderNodeOutputMaterial Surface<add.Shader)");
  ShadingContext context = context_at({1.0f, 2.0f, 6.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(context.emission, Spectrum(1.0f + 3.0f, 2.0f, 6.0f));

  const auto luminous = compiled(R"(
    p: Pattern Vector<q.Position
    q: Position
    e: ShaderNodeEmission Strength<p.Color
    out: ShaderNodeOutputMaterial Surface<e.Emission)");
  luminous.run(luminous.material.surface, k_query_surface, context);
  EXPECT_FLOAT_EQ(context.emission.r, luminance(Spectrum(1.0f, 2.0f, 6.0f)));
}

TEST(Compiler, MakesEmissionOfValuesLinkedToShaders) {
  const auto number = compiled("h: Half Value=6\nout: ShaderNodeOutputMaterial Surface<h.Half");
  EXPECT_EQ(number.material.constant_emission, Spectrum(3.0f));
  const auto color = compiled("p: Pattern\nout: ShaderNodeOutputMaterial Surface<p.Color");
  ShadingContext context = context_at({});
  color.run(color.material.surface, k_query_surface, context);
  EXPECT_EQ(context.emission, Spectrum(0.25f, 0.75f, 0.0f));  // of the implied UV
}

TEST(Compiler, ReportsAShaderLinkedToAValue) {
  const auto m = compiled(R"(
    d: ShaderNodeBsdfDiffuse
    e: ShaderNodeEmission Strength=2 Strength<d.BSDF
    out: ShaderNodeOutputMaterial Surface<e.Emission)");
  ASSERT_EQ(m.reports.size(), 1u);
  EXPECT_EQ(m.material.constant_emission, Spectrum(2.0f));
}

TEST(Compiler, ImpliesCoordinates) {
  const auto m = compiled(R"(
    p: Pattern
    e: ShaderNodeEmission Color<p.Color
    out: ShaderNodeOutputMaterial Surface<e.Emission)");
  EXPECT_EQ(m.material.surface.listing(),
            "UV r0:2 = ShaderNodeTexCoord()\n"
            "r3:5 = Pattern(r0:2)\n"
            "ShaderNodeEmission(r3:5, 1; weight 1)\n");
}

TEST(Compiler, BreaksCyclesWithAReport) {
  const auto m = compiled(R"(
    a: Half Value=8 Value<b.Half
    b: Half Value<a.Half
    e: ShaderNodeEmission Strength<a.Half
    out: ShaderNodeOutputMaterial Surface<e.Emission)");
  ASSERT_EQ(m.reports.size(), 1u);
  EXPECT_NE(m.reports[0].find("cycle"), std::string::npos);
  EXPECT_TRUE(m.material.emits);

  const auto shaders = compiled(R"(
    a: ShaderNodeAddShader Shader<b.Shader Shader_001<e.Emission
    b: ShaderNodeAddShader Shader<a.Shader
    e: ShaderNodeEmission
    out: ShaderNodeOutputMaterial Surface<a.Shader)");
  EXPECT_EQ(shaders.reports.size(), 1u);
  EXPECT_EQ(shaders.material.constant_emission, Spectrum(1.0f));
}

TEST(Compiler, ReportsNodesOfUnknownTypeAndStandsIn) {
  const auto m = compiled(R"(
    u: ShaderNodeUnheardOf
    v: ShaderNodeUnheardOf
    e: ShaderNodeEmission Color=1,1,1 Strength=3 Strength<u.Fac
    add: ShaderNodeAddShader Shader<e.Emission Shader_001<v.BSDF
    out: ShaderNodeOutputMaterial Surface<add.Shader)");
  ASSERT_EQ(m.reports.size(), 2u);  // each by its name
  EXPECT_NE(m.reports[0].find("ShaderNodeUnheardOf"), std::string::npos);
  EXPECT_EQ(m.material.constant_emission, Spectrum(3.0f));
  ShadingContext context = context_at({});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_FLOAT_EQ(context.bsdf.albedo().g, 0.8f);
}

TEST(Compiler, SaysNothingOfNodesThatNothingNeeds) {
  const auto m = compiled(R"(
    u: ShaderNodeUnheardOf
    h: Half Value<u.Fac
    out: ShaderNodeOutputMaterial)");
  EXPECT_TRUE(m.reports.empty());
  EXPECT_TRUE(m.material.surface.empty());
  EXPECT_TRUE(m.material.has_surface);
}

TEST(Compiler, ReportsUnknownSocketsSettingsAndWrongTypes) {
  NodeGraph graph = GraphText::parse(R"(
    g: ShaderNodeBsdfGlossy Color=1 Roughness=0.5,1 Nothing=1 @distribution=VELVET @colour=RED
    out: ShaderNodeOutputMaterial Surface<g.BSDF Surface_2<g.BSDF Volume<g.BSDF)");
  graph.nodes[0].inputs["Roughness"] = {std::numeric_limits<float>::quiet_NaN()};
  graph.nodes[0].settings["distribution"] = 7;
  graph.links.push_back({0, "BSDF", 99, "Surface"});
  const TestMaterial m(graph, {}, true, &test_registry());
  // Color, Roughness, Nothing, distribution, colour, Surface_2, the link to node 99.
  EXPECT_EQ(m.reports.size(), 7u);
  EXPECT_EQ(m.material.surface.listing(),
            "ShaderNodeBsdfGlossy(RED, 7, (0.8, 0.8, 0.8), 0.5, normal; weight 1)\n");
}

TEST(Compiler, SurvivesAGraphWithoutOutput) {
  for (const int output : {-1, 7}) {
    NodeGraph graph;
    graph.output = output;
    const TestMaterial m(graph, {}, true, &test_registry());
    EXPECT_TRUE(m.material.surface.empty());
    EXPECT_FALSE(m.material.emits);
  }
  CompileContext context;
  context.registry = &test_registry();
  EXPECT_TRUE(compile_material({}, context).surface.empty());
}

TEST(Compiler, KnowsAVolumeWithoutSurface) {
  const auto m = compiled(R"(
    v: ShaderNodeBsdfDiffuse
    out: ShaderNodeOutputMaterial Volume<v.BSDF)");
  EXPECT_FALSE(m.material.has_surface);
  EXPECT_TRUE(m.material.is_transparent);
  EXPECT_FALSE(m.material.scatters);
}

TEST(Compiler, WorldsOnlyEmit) {
  NodeGraph graph = GraphText::parse(R"(
    b: ShaderNodeBackground Color=1,1,1 Strength=2
    d: ShaderNodeBsdfDiffuse
    add: ShaderNodeAddShader Shader<b.Background Shader_001<d.BSDF
    out: ShaderNodeOutputWorld Surface<add.Shader)");
  const TestMaterial m(graph, {nullptr, ShaderDomain::world, {}}, true, &test_registry());
  EXPECT_FALSE(m.material.scatters);
  EXPECT_EQ(m.material.constant_emission, Spectrum(2.0f));
  EXPECT_EQ(m.material.surface.listing(), "ShaderNodeBackground((1, 1, 1), 2; weight 1)\n");
}

TEST(Compiler, LongChainsTakeFewRegisters) {
  std::string text = "n0: Probe\n";
  std::string last = "n0.Value";
  for (int i = 1; i < 500; ++i) {
    const std::string name = "n" + std::to_string(i);
    text += name;
    text += ": Half Value<" + last + "\n";
    last = name + ".Half";
  }
  text += "e: ShaderNodeEmission Strength<" + last;
  text += "\nout: ShaderNodeOutputMaterial Surface<e.Emission";
  const NodeGraph graph = GraphText::parse(text);
  const TestMaterial m(graph, {}, true, &test_registry());
  const std::string listing = m.material.surface.listing();
  EXPECT_EQ(std::count(listing.begin(), listing.end(), '\n'), 501);
  EXPECT_LE(m.material.surface.register_count(), 3u);
}

TEST(RequiredTangents, NamesTheUvMapsOfTangentNodes) {
  NodeGraph graph = GraphText::parse(R"(
    a: ShaderNodeNormalMap @uv_map=Bricks
    b: ShaderNodeNormalMap @space=TANGENT
    c: ShaderNodeNormalMap @space=OBJECT @uv_map=No
    d: ShaderNodeTangent @direction_type=UV_MAP @uv_map=Hair
    e: ShaderNodeTangent @direction_type=RADIAL @uv_map=No
    f: ShaderNodeNormalMap @uv_map=Bricks)");
  EXPECT_EQ(required_tangents(graph), (std::vector<std::string>{"", "Bricks", "Hair"}));
}

}  // namespace
}  // namespace tenniel
