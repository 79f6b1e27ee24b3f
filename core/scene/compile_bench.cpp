// SPDX-License-Identifier: Apache-2.0
// How long shaders take to compile: `./tenniel bench shaders`. Prints figures, judges none.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "scene/compile_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

// Layers of noise, ramped, mixed over what is below and bumped, as artists stack them: six nodes
// each, all different, so that neither folding nor sharing takes any away.
NodeGraph layered(int nodes, float variation) {
  GraphBuilder g("layers");
  const uint32_t coordinate = g.add("ShaderNodeTexCoord");
  const uint32_t principled = g.add("ShaderNodeBsdfPrincipled");
  const std::vector<float> ramp(256 * 4, 0.5f);
  uint32_t below = 0, normal = 0;
  for (int layer = 0; 6 * (layer + 1) + 3 <= nodes; ++layer) {
    const auto scale = variation + static_cast<float>(layer);
    const uint32_t mapping = g.add("ShaderNodeMapping", {{"Location", {scale, 0.0f, 0.0f}}});
    const uint32_t noise = g.add("ShaderNodeTexNoise", {{"Scale", {scale}}});
    const uint32_t colors = g.add("ShaderNodeValToRGB", {}, {{"color_ramp", ramp}});
    const uint32_t mix = g.add("ShaderNodeMixRGB", {{"Color1", grey(0.1f)}});
    const uint32_t math = g.add("ShaderNodeMath", {{"Value_001", {scale}}});
    const uint32_t bump = g.add("ShaderNodeBump");
    g.link(coordinate, "Object", mapping, "Vector").link(mapping, "Vector", noise, "Vector");
    g.link(noise, "Fac", colors, "Fac").link(noise, "Fac", mix, "Fac");
    g.link(colors, "Color", mix, "Color2").link(noise, "Fac", math, "Value");
    g.link(math, "Value", bump, "Height");
    if (layer > 0) g.link(below, "Color", mix, "Color1").link(normal, "Normal", bump, "Normal");
    below = mix;
    normal = bump;
  }
  g.link(below, "Color", principled, "Base Color").link(normal, "Normal", principled, "Normal");
  return g.surface(principled).build();
}

// Least of several runs, in milliseconds.
template <class Work>
double fastest(const Work& work) {
  double best = 1e30;
  for (int run = 0; run < 7; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const auto end = std::chrono::steady_clock::now();
    best = std::min(best, std::chrono::duration<double, std::milli>(end - start).count());
  }
  return best;
}

double one_material(int nodes) {
  const NodeGraph graph = layered(nodes, 1.0f);
  return fastest([&] {
    AttributeIds attributes;
    CompileContext context;
    context.attributes = &attributes;
    compile_material({&graph, ShaderDomain::surface, DisplacementMethod::bump}, context);
  });
}

double many_materials(int count, int nodes) {
  SceneDescription description;
  for (int i = 0; i < count; ++i) {
    MaterialDesc& material = description.materials.emplace_back();
    material.graph = layered(nodes, static_cast<float>(i));
  }
  return fastest([&] {
    Diagnostics diagnostics;
    compile_scene(description, diagnostics, {});
  });
}

}  // namespace
}  // namespace tenniel

int main() {
  std::printf("a material of 500 nodes: %6.2f ms\n", tenniel::one_material(500));
  std::printf("200 materials of 40 nodes: %6.1f ms\n", tenniel::many_materials(200, 40));
}
