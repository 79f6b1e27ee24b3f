// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "shading/nodes/register.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

// How often each probe ran: skipped branches must not.
std::array<int, 8> probe_runs{};

struct CountingProbeNode {
  Input<float> slot, value;
  Output<float> result;
  void eval(ShadingContext& context) const {
    ++probe_runs[static_cast<size_t>(context.get(slot))];
    context.set(result, context.get(value));
  }
};

// x, y and z of the point, so that a test decides what a factor is when it runs.
struct AxesNode {
  Output<float> x, y, z;
  void eval(ShadingContext& context) const {
    context.set(x, context.surface.position.x);
    context.set(y, context.surface.position.y);
    context.set(z, context.surface.position.z);
  }
};

struct SumNode {
  Input<float> a, b;
  Output<float> sum;
  void eval(ShadingContext& context) const { context.set(sum, context.get(a) + context.get(b)); }
};

struct TurnNode {
  Input<Vec3> a, b;
  Output<Vec3> turned;
  void eval(ShadingContext& context) const {
    const Vec3 v = context.get(a), w = context.get(b);
    context.set(turned, Vec3{v.y + w.x, v.z - w.y, v.x});
  }
};

struct TintNode {
  Input<Spectrum> color;
  Input<float> amount;
  Output<Spectrum> tinted;
  Output<float> red;
  void eval(ShadingContext& context) const {
    const Spectrum c = context.get(color) * 0.5f + Spectrum(0.1f, 0.2f, 0.3f);
    context.set(tinted, c * context.get(amount));
    context.set(red, c.r);
  }
};

const NodeRegistry& test_registry() {
  static const NodeRegistry registry = [] {
    NodeRegistry r;
    register_closure_nodes(r);
    register_principled_nodes(r);
    register_bump_nodes(r);
    register_output_nodes(r);
    r.add<CountingProbeNode>("Probe")
        .input("Slot", &CountingProbeNode::slot)
        .input("Value", &CountingProbeNode::value)
        .output("Value", &CountingProbeNode::result)
        .varying();
    r.add<AxesNode>("Axes")
        .output("X", &AxesNode::x)
        .output("Y", &AxesNode::y)
        .output("Z", &AxesNode::z)
        .varying();
    r.add<SumNode>("Sum")
        .input("A", &SumNode::a)
        .input("B", &SumNode::b)
        .output("Sum", &SumNode::sum);
    r.add<TurnNode>("Turn")
        .input("A", &TurnNode::a)
        .input("B", &TurnNode::b)
        .output("Turned", &TurnNode::turned);
    r.add<TintNode>("Tint")
        .input("A", &TintNode::color)
        .input("B", &TintNode::amount)
        .output("Tinted", &TintNode::tinted)
        .output("Red", &TintNode::red);
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
  probe_runs.fill(0);
  return context;
}

constexpr const char* k_nested = R"(
  axes: Axes
  e: ShaderNodeEmission Color=1,0,0
  f: ShaderNodeEmission Color=0,1,0
  g: ShaderNodeEmission Color=0,0,1
  inner: ShaderNodeMixShader Fac<axes.Y Shader<e.Emission Shader_001<f.Emission
  outer: ShaderNodeMixShader Fac<axes.X Shader<g.Emission Shader_001<inner.Shader
  out: ShaderNodeOutputMaterial Surface<outer.Shader)";

TEST(ClosureWeights, MultiplyDownNestedMixes) {
  const auto m = compiled(k_nested);
  ShadingContext context = context_at({0.25f, 0.5f, 0.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(context.emission, Spectrum(0.125f, 0.125f, 0.75f));
  context.surface.position = {7.0f, -1.0f, 0.0f};  // factors are kept in [0, 1]
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(context.emission, Spectrum(1.0f, 0.0f, 0.0f));
}

TEST(ClosureWeights, AreRegistersOfANestedProgram) {
  EXPECT_EQ(compiled(k_nested).material.surface.listing(),
            "X r0, Y r1 = Axes()\n"
            "first r2, second r3 = MixWeights(1, r0)\n"
            "skip 5 if r3 is 0\n"
            "first r0, second r4 = MixWeights(r3, r1)\n"
            "skip 1 if r4 is 0\n"
            "ShaderNodeEmission((0, 1, 0), 1; weight r4)\n"
            "skip 1 if r0 is 0\n"
            "ShaderNodeEmission((1, 0, 0), 1; weight r0)\n"
            "skip 1 if r2 is 0\n"
            "ShaderNodeEmission((0, 0, 1), 1; weight r2)\n");
}

TEST(ClosureWeights, AddUpWhereAShaderIsReachedTwice) {
  const auto m = compiled(R"(
    axes: Axes
    e: ShaderNodeEmission
    d: ShaderNodeBsdfDiffuse
    mix: ShaderNodeMixShader Fac<axes.X Shader<e.Emission Shader_001<d.BSDF
    twice: ShaderNodeAddShader Shader<e.Emission Shader_001<mix.Shader
    out: ShaderNodeOutputMaterial Surface<twice.Shader)");
  ShadingContext context = context_at({0.25f, 0.0f, 0.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_FLOAT_EQ(context.emission.r, 1.75f);
  EXPECT_FLOAT_EQ(context.bsdf.albedo().r, 0.25f * 0.8f);
}

TEST(ClosureWeights, DropWhatAConstantFactorHides) {
  const auto m = compiled(R"(
    axes: Axes
    seen: ShaderNodeEmission
    hidden: ShaderNodeBsdfTransparent
    inner: ShaderNodeMixShader Fac=0 Shader<seen.Emission Shader_001<hidden.BSDF
    d: ShaderNodeBsdfDiffuse
    outer: ShaderNodeMixShader Fac<axes.X Shader<inner.Shader Shader_001<d.BSDF
    out: ShaderNodeOutputMaterial Surface<outer.Shader)");
  EXPECT_FALSE(m.material.is_transparent);
  EXPECT_EQ(m.material.emission.listing(),
            "X r0 = Axes()\n"
            "first r1 = MixWeights(1, r0)\n"
            "skip 1 if r1 is 0\n"
            "ShaderNodeEmission((1, 1, 1), 1; weight r1)\n");
}

TEST(ClosureWeights, SkipWhatOnlyADarkBranchNeeds) {
  const auto m = compiled(R"(
    axes: Axes
    first: Probe Slot=1 Value<axes.Z
    second: Probe Slot=2 Value<axes.Z
    both: Probe Slot=3 Value<axes.Z
    deep: Probe Slot=4 Value<second.Value
    e: ShaderNodeEmission Strength<first.Value
    f: ShaderNodeEmission Strength<deep.Value Color<both.Value
    g: ShaderNodeEmission Strength<both.Value
    add: ShaderNodeAddShader Shader<e.Emission Shader_001<g.Emission
    mix: ShaderNodeMixShader Fac<axes.X Shader<add.Shader Shader_001<f.Emission
    out: ShaderNodeOutputMaterial Surface<mix.Shader)");
  ShadingContext context = context_at({0.0f, 0.0f, 3.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(probe_runs, (std::array<int, 8>{0, 1, 0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(context.emission, Spectrum(6.0f));

  context = context_at({1.0f, 0.0f, 3.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(probe_runs, (std::array<int, 8>{0, 0, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(context.emission, Spectrum(9.0f));
}

TEST(ClosureWeights, KeepSharedNodesOfABranchInsideIt) {
  const auto m = compiled(R"(
    axes: Axes
    rust: Probe Slot=1 Value<axes.Z
    e: ShaderNodeEmission Strength<rust.Value
    f: ShaderNodeEmission Strength<rust.Value Color=0,0,1
    inner: ShaderNodeMixShader Fac<axes.Y Shader<e.Emission Shader_001<f.Emission
    outer: ShaderNodeMixShader Fac<axes.X Shader_001<inner.Shader
    out: ShaderNodeOutputMaterial Surface<outer.Shader)");
  ShadingContext context = context_at({0.0f, 0.5f, 1.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(probe_runs[1], 0);
  context = context_at({1.0f, 0.5f, 1.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(probe_runs[1], 1);
  EXPECT_EQ(context.emission, Spectrum(0.5f, 0.5f, 1.0f));
}

TEST(ClosureWeights, StayLinearInSharedDiamonds) {
  std::string text = "axes: Axes\nm0: ShaderNodeEmission\n";
  std::string last = "m0.Emission";
  for (int i = 1; i <= 60; ++i) {
    const std::string name = "m" + std::to_string(i);
    text.append(name).append(": ShaderNodeMixShader Fac<axes.X Shader<").append(last);
    text.append(" Shader_001<").append(last).append("\n");
    last = name + ".Shader";
  }
  const auto m = compiled(text + "out: ShaderNodeOutputMaterial Surface<" + last);
  ShadingContext context = context_at({0.3f, 0.0f, 0.0f});
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_NEAR(context.emission.r, 1.0f, 1e-5f);
}

TEST(Queries, TransparencyNeedsOnlyAlpha) {
  const auto m = compiled(R"(
    axes: Axes
    rough: Probe Slot=1 Value<axes.Y
    glow: Probe Slot=2 Value<axes.Z
    p: ShaderNodeBsdfPrincipled Alpha<axes.X Roughness<rough.Value Emission<glow.Value
    out: ShaderNodeOutputMaterial Surface<p.BSDF)");
  EXPECT_TRUE(m.material.is_transparent && m.material.scatters && m.material.emits);
  ShadingContext context = context_at({0.25f, 0.5f, 2.0f});
  m.run(m.material.transparency, k_query_transparency, context);
  EXPECT_EQ(probe_runs, (std::array<int, 8>{}));
  EXPECT_EQ(context.transparency, Spectrum(0.75f));
  EXPECT_EQ(context.emission, Spectrum());
  m.run(m.material.emission, k_query_emission, context);
  EXPECT_EQ(probe_runs, (std::array<int, 8>{0, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(context.emission, Spectrum(0.5f));
  EXPECT_EQ(context.transparency, Spectrum());
  m.run(m.material.surface, k_query_surface, context);
  EXPECT_EQ(context.emission, Spectrum(0.5f));
  EXPECT_EQ(context.transparency, Spectrum(0.75f));
  EXPECT_FALSE(context.bsdf.empty());
}

TEST(Queries, AnOpaqueSurfaceHasNoTransparencyProgram) {
  const auto m = compiled(R"(
    d: ShaderNodeBsdfDiffuse
    p: ShaderNodeBsdfPrincipled
    black: ShaderNodeBsdfTransparent Color=0,0,0
    off: ShaderNodeEmission Strength=0
    a: ShaderNodeAddShader Shader<d.BSDF Shader_001<p.BSDF
    b: ShaderNodeAddShader Shader<black.BSDF Shader_001<off.Emission
    c: ShaderNodeAddShader Shader<a.Shader Shader_001<b.Shader
    out: ShaderNodeOutputMaterial Surface<c.Shader)");
  EXPECT_TRUE(m.material.transparency.empty());
  EXPECT_TRUE(m.material.emission.empty());
  EXPECT_FALSE(m.material.is_transparent || m.material.emits);
  EXPECT_TRUE(m.material.scatters);
}

// Random trees of shaders over random values of every type: conversions, folding, sharing, weights
// and jumps must not show.
class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  std::string text() {
    std::string text = "axes: Axes\n";
    for (int i = 0; i < 14; ++i)
      text += value_node("v" + std::to_string(i));
    for (int i = 0; i < 4; ++i)
      text += closure_node("s" + std::to_string(i), i % 2 == 0);
    for (int i = 0; i < 8; ++i)
      text += combiner("m" + std::to_string(i));
    return text + "out: ShaderNodeOutputMaterial Surface<" + shaders_.back();
  }

 private:
  size_t pick(size_t n) { return random_() % n; }

  std::string operand(const std::string& socket, bool is_number) {
    if (pick(3) != 0) return " " + socket + "<" + values_[pick(values_.size())];
    const std::string constant = std::to_string(pick(4));
    return " " + socket + "=" + (is_number ? constant : constant + ",1,0.5");
  }

  std::string value_node(const std::string& name) {
    const size_t kind = pick(3);
    const char* type = kind == 0 ? "Sum" : kind == 1 ? "Turn" : "Tint";
    const std::string line = name + ": " + type + operand("A", kind == 0) + operand("B", kind != 1);
    values_.push_back(name + (kind == 0 ? ".Sum" : kind == 1 ? ".Turned" : ".Tinted"));
    if (kind == 2) values_.push_back(name + ".Red");
    return line + "\n";
  }

  std::string closure_node(const std::string& name, bool emits) {
    shaders_.push_back(name + (emits ? ".Emission" : ".BSDF"));
    return name +
           (emits ? ": ShaderNodeEmission" + operand("Strength", true)
                  : ": ShaderNodeBsdfTransparent" + operand("Color", false)) +
           "\n";
  }

  std::string combiner(const std::string& name) {
    const bool adds = pick(3) == 0;
    std::string line =
        name + (adds ? ": ShaderNodeAddShader" : ": ShaderNodeMixShader" + operand("Fac", true));
    line += " Shader<" + shaders_[pick(shaders_.size())];
    line += " Shader_001<" + shaders_[pick(shaders_.size())] + "\n";
    shaders_.push_back(name + ".Shader");
    return line;
  }

  std::mt19937 random_;
  std::vector<std::string> values_{"axes.X", "axes.Y", "axes.Z"}, shaders_;
};

TEST(Optimiser, ChangesNoResultOfRandomTrees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-0.2f, 1.2f);
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text = RandomTree(seed).text();
    const auto plain = compiled(text, false), fast = compiled(text, true);
    for (int point = 0; point < 4; ++point) {
      const Vec3 position{uniform(random), point == 0 ? 0.0f : uniform(random),
                          point == 1 ? 1.0f : uniform(random)};
      ShadingContext expected = context_at(position), got = context_at(position);
      plain.run(plain.material.surface, k_query_surface, expected);
      fast.run(fast.material.surface, k_query_surface, got);
      const float scale = 1e-5f * (1.0f + std::abs(expected.emission.r));
      const float scale_through = 1e-5f * (1.0f + std::abs(expected.transparency.g));
      ASSERT_NEAR(got.emission.r, expected.emission.r, scale) << text;
      ASSERT_NEAR(got.transparency.g, expected.transparency.g, scale_through) << text;
      fast.run(fast.material.emission, k_query_emission, got);
      ASSERT_NEAR(got.emission.r, expected.emission.r, scale) << text;
      fast.run(fast.material.transparency, k_query_transparency, got);
      ASSERT_NEAR(got.transparency.g, expected.transparency.g, scale_through) << text;
      if (fast.material.is_emission_constant) {
        ASSERT_NEAR(fast.material.constant_emission.r, expected.emission.r, scale) << text;
      }
    }
  }
}

}  // namespace
}  // namespace tenniel
