// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/bump.h"

#include <gtest/gtest.h>

#include "math/numeric.h"
#include "shading/nodes/register.h"
#include "shading/nodes/test_surface.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

// Heights: x of the world point times `slope`, and u of the surface.
struct SlopeNode {
  Input<float> slope{1.0f};
  Output<float> x, y;
  void eval(ShadingContext& context) const {
    context.set(x, context.get(slope) * context.surface.position.x);
    context.set(y, context.get(slope) * context.surface.position.y);
  }
};

// Makes a direction visible as a colour.
struct DirectionNode {
  Input<Vec3> normal;
  Output<Vec3> direction;
  void eval(ShadingContext& context) const { context.set(direction, context.normal(normal)); }
};

const NodeRegistry& test_registry() {
  static const NodeRegistry registry = [] {
    NodeRegistry r;
    register_closure_nodes(r);
    register_bump_nodes(r);
    register_output_nodes(r);
    r.add<SlopeNode>("Slope")
        .input("Slope", &SlopeNode::slope)
        .output("X", &SlopeNode::x)
        .output("Y", &SlopeNode::y)
        .varying();
    r.add<DirectionNode>("Direction")
        .input("Normal", &DirectionNode::normal)
        .implicit(ImplicitInput::normal)
        .output("Direction", &DirectionNode::direction)
        .varying();
    return r;
  }();
  return registry;
}

constexpr Vec3 k_up{0.0f, 0.0f, 1.0f};

// The normal that `nodes` (which define "d: Direction ...") give on a triangle.
struct BumpedNormal {
  TestMaterial material;
  TestSurface surface;

  explicit BumpedNormal(const std::string& nodes, const Transform& placed = {})
      : material(nodes + R"(
          emit: ShaderNodeEmission Color<d.Direction
          out: ShaderNodeOutputMaterial Surface<emit.Emission)",
                 true, &test_registry()),
        surface(material.attributes, placed) {}

  Vec3 at(float x, float y, Vec3 wo = k_up) {
    ShadingContext context;
    context.surface = surface.at(x, y, wo);
    material.run(material.material.surface, k_query_surface, context);
    return {context.emission.r, context.emission.g, context.emission.b};
  }
};

void expect_near(Vec3 got, Vec3 expected, float tolerance = 1e-4f) {
  EXPECT_NEAR(distance(got, expected), 0.0f, tolerance) << got.x << ", " << got.y << ", " << got.z;
}

TEST(Bump, TiltsAgainstALinearHeightExactly) {
  BumpedNormal bump(
      "h: Slope Slope=0.5\nb: ShaderNodeBump Height<h.X\nd: Direction Normal<b.Normal");
  expect_near(bump.at(0.3f, 0.3f), normalize(Vec3{-0.5f, 0.0f, 1.0f}));
}

TEST(Bump, DistanceScalesAndStrengthMixes) {
  BumpedNormal far(
      "h: Slope Slope=0.5\nb: ShaderNodeBump Distance=0.2 Height<h.Y\nd: Direction "
      "Normal<b.Normal");
  expect_near(far.at(0.3f, 0.3f), normalize(Vec3{0.0f, -0.1f, 1.0f}));
  BumpedNormal half(
      "h: Slope Slope=0.5\nb: ShaderNodeBump Strength=0.5 Height<h.X\nd: Direction "
      "Normal<b.Normal");
  const Vec3 full = normalize(Vec3{-0.5f, 0.0f, 1.0f});
  expect_near(half.at(0.3f, 0.3f), normalize(0.5f * full + 0.5f * k_up));
}

TEST(Bump, InvertTurnsTheTilt) {
  NodeGraph graph = GraphText::parse(
      "h: Slope Slope=0.5\nb: ShaderNodeBump Height<h.X\nd: Direction Normal<b.Normal\n"
      "e: ShaderNodeEmission Color<d.Direction\nout: ShaderNodeOutputMaterial Surface<e.Emission");
  graph.nodes[1].settings["invert"] = true;
  const TestMaterial m(graph, {}, true, &test_registry());
  AttributeIds ids;
  ShadingContext context;
  const TestSurface surface(ids);
  context.surface = surface.at(0.3f, 0.3f, k_up);
  m.run(m.material.surface, k_query_surface, context);
  expect_near({context.emission.r, context.emission.g, context.emission.b},
              normalize(Vec3{0.5f, 0.0f, 1.0f}));
}

TEST(Bump, LeavesAFlatHeightAlone) {
  BumpedNormal constant("b: ShaderNodeBump Height=0.7\nd: Direction Normal<b.Normal");
  EXPECT_EQ(constant.at(0.3f, 0.3f), k_up);
  BumpedNormal zero("h: Slope Slope=0\nb: ShaderNodeBump Height<h.X\nd: Direction Normal<b.Normal");
  EXPECT_EQ(zero.at(0.3f, 0.3f), k_up);
}

TEST(Bump, StacksThroughItsNormal) {
  BumpedNormal stacked(R"(
    h: Slope Slope=0.25
    a: ShaderNodeBump Height<h.X
    b: ShaderNodeBump Height<h.Y Normal<a.Normal
    d: Direction Normal<b.Normal)");
  const Vec3 n = stacked.at(0.3f, 0.3f);
  EXPECT_LT(n.x, -0.2f);
  EXPECT_LT(n.y, -0.2f);
  EXPECT_NEAR(length(n), 1.0f, 1e-5f);
}

TEST(Bump, HeightsMayReadOtherBumps) {
  // The inner normal is the same everywhere, so the outer height is flat.
  BumpedNormal nested(R"(
    h: Slope Slope=0.5
    a: ShaderNodeBump Height<h.X
    n: Direction Normal<a.Normal
    b: ShaderNodeBump Height<n.Direction
    d: Direction Normal<b.Normal)");
  expect_near(nested.at(0.3f, 0.3f), k_up, 1e-3f);
}

TEST(Bump, HoldsItsHeightAsAProgram) {
  const TestMaterial m(R"(
    h: Slope
    b: ShaderNodeBump Height<h.X
    g: ShaderNodeBsdfGlossy Normal<b.Normal
    out: ShaderNodeOutputMaterial Surface<g.BSDF)",
                       true, &test_registry());
  EXPECT_EQ(m.material.surface.listing(),
            "X r0 = Slope(1)\n"
            "r1:3 = ShaderNodeBump(1, 1, r4, normal)\n"
            "  X r4 = Slope(1)\n"
            "ShaderNodeBsdfGlossy((0.8, 0.8, 0.8), 0.5, r1:3; weight 1)\n");
  EXPECT_EQ(m.material.surface.register_count(), 5u);
  EXPECT_TRUE(m.material.emission.empty());
}

TEST(Bump, SharesTheHeightAtThePointWithOtherReaders) {
  const TestMaterial m(R"(
    h: Slope
    b: ShaderNodeBump Height<h.X
    g: ShaderNodeBsdfGlossy Roughness<h.X Normal<b.Normal
    out: ShaderNodeOutputMaterial Surface<g.BSDF)",
                       true, &test_registry());
  EXPECT_EQ(m.material.surface.listing(),
            "X r0 = Slope(1)\n"
            "r1:3 = ShaderNodeBump(1, 1, r4, normal)\n"
            "  X r4 = Slope(1)\n"
            "ShaderNodeBsdfGlossy((0.8, 0.8, 0.8), r0, r1:3; weight 1)\n");
}

TEST(Bump, NeverMirrorsBelowTheSurface) {
  BumpedNormal steep(
      "h: Slope Slope=8\nb: ShaderNodeBump Height<h.X\nd: Direction Normal<b.Normal");
  for (float angle = 0.05f; angle < 3.1f; angle += 0.1f) {
    const Vec3 wo{std::cos(angle), 0.0f, std::sin(angle)};
    EXPECT_GE(reflect(wo, steep.at(0.3f, 0.3f, wo)).z, 0.0f) << angle;
  }
}

TEST(Displacement, BendsUnlinkedNormalsAsBump) {
  // The height of a Displacement node is along the object's normal: 0.5 x as bump.
  BumpedNormal m("h: Slope Slope=0.5\nd: Direction");
  const std::string text = R"(
    h: Slope Slope=0.5
    p: ShaderNodeDisplacement Height<h.X
    d: Direction
    e: ShaderNodeEmission Color<d.Direction
    f: ShaderNodeBsdfDiffuse
    add: ShaderNodeAddShader Shader<e.Emission Shader_001<f.BSDF
    out: ShaderNodeOutputMaterial Surface<add.Shader Displacement<p.Displacement)";
  const TestMaterial bump(GraphText::parse(text), {}, true, &test_registry());
  ShadingContext context;
  context.surface = m.surface.at(0.3f, 0.3f, k_up);
  bump.run(bump.material.surface, k_query_surface, context);
  const Vec3 tilted = normalize(Vec3{-0.5f, 0.0f, 1.0f});
  expect_near({context.emission.r, context.emission.g, context.emission.b}, tilted);
  expect_near(context.bsdf.average_normal(), tilted);
  EXPECT_TRUE(bump.reports.empty());

  MaterialSource source;
  source.displacement = DisplacementMethod::both;
  const TestMaterial both(GraphText::parse(text), source, true, &test_registry());
  EXPECT_TRUE(both.reports.empty());
  EXPECT_TRUE(both.material.displaces);
  EXPECT_FALSE(bump.material.displaces);
}

TEST(Displacement, FollowsTheObjectsScale) {
  const Transform tall{{1, 0, 0}, {0, 1, 0}, {0, 0, 3}, {}};
  const std::string head = "h: Slope Slope=0.25\np: ShaderNodeDisplacement Height<h.X ";
  const std::string tail = R"(
    d: Direction
    e: ShaderNodeEmission Color<d.Direction
    out: ShaderNodeOutputMaterial Surface<e.Emission Displacement<p.Displacement)";
  for (const auto& [space, slope] : {std::pair{"@space=OBJECT", 0.75f}, {"@space=WORLD", 0.25f}}) {
    const TestMaterial m(std::string(head).append(space).append(tail), true, &test_registry());
    AttributeIds ids;
    const TestSurface surface(ids, tall);
    ShadingContext context;
    context.surface = surface.at(0.3f, 0.3f, k_up);
    m.run(m.material.surface, k_query_surface, context);
    expect_near({context.emission.r, context.emission.g, context.emission.b},
                normalize(Vec3{-slope, 0.0f, 1.0f}));
  }
}

TEST(NormalMap, FlatBlueIsTheShadingNormal) {
  for (const char* space : {"TANGENT", "OBJECT", "WORLD"}) {
    BumpedNormal map(std::string("m: ShaderNodeNormalMap @space=") + space +
                     " Color=0.5,0.5,1,1\nd: Direction Normal<m.Normal");
    expect_near(map.at(0.3f, 0.3f), k_up, 1e-6f);
    EXPECT_TRUE(map.material.reports.empty());
  }
}

TEST(NormalMap, TiltsAlongTheTangent) {
  const Vec3 n = normalize(Vec3{0.6f, 0.2f, 0.8f});
  const std::string text =
      "m: ShaderNodeNormalMap Color=0.8,0.6,0.9,1\nd: Direction Normal<m.Normal";
  BumpedNormal map(text);
  expect_near(map.at(0.3f, 0.3f), n, 1e-5f);
  // Turned a quarter about Z: the tangent turns with the object.
  BumpedNormal turned(text, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}});
  expect_near(turned.at(0.3f, 0.3f), {-n.y, n.x, n.z}, 1e-5f);
  // Seen from behind the normal points back at the viewer.
  expect_near(map.at(0.3f, 0.3f, -k_up), -n, 1e-5f);
}

TEST(NormalMap, StrengthMovesTowardsTheMap) {
  BumpedNormal map(
      "m: ShaderNodeNormalMap Strength=0.5 Color=0.8,0.6,0.9,1\nd: Direction Normal<m.Normal");
  const Vec3 n = normalize(Vec3{0.6f, 0.2f, 0.8f});
  expect_near(map.at(0.3f, 0.3f), normalize(k_up + 0.5f * (n - k_up)), 1e-5f);
}

// Blender leaves that to the shaders.
TEST(NormalMap, MayMirrorBelowTheSurface) {
  BumpedNormal map(
      "m: ShaderNodeNormalMap @space=WORLD Color=1,0.5,0.6,1\nd: Direction Normal<m.Normal");
  expect_near(map.at(0.3f, 0.3f), normalize(Vec3{1.0f, 0.0f, 0.2f}), 1e-5f);
}

TEST(NormalMap, AsksForTheUvMapItsTangentsDeriveFrom) {
  const TestMaterial m(R"(
    n: ShaderNodeNormalMap @uv_map=Bricks
    g: ShaderNodeBsdfGlossy Normal<n.Normal
    out: ShaderNodeOutputMaterial Surface<g.BSDF)",
                       true, &test_registry());
  for (const char* name : {"Bricks", "Bricks.tangent", "Bricks.tangent.sign"})
    EXPECT_NE(m.attributes.find(name), AttributeIds::k_none) << name;
}

TEST(NormalMap, WithoutTangentsIsTheShadingNormal) {
  BumpedNormal map(
      "m: ShaderNodeNormalMap @uv_map=Missing Color=1,0,0\nd: Direction Normal<m.Normal");
  expect_near(map.at(0.3f, 0.3f), k_up, 1e-6f);
}

}  // namespace
}  // namespace tenniel
