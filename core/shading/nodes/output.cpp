// SPDX-License-Identifier: Apache-2.0
#include "shading/node_type.h"
#include "shading/nodes/register.h"

// Nodes that direct closures; the compiler takes them apart and none is ever run.
namespace tenniel {
namespace {

struct MaterialOutputNode {
  Input<Vec3> displacement;
  Input<float> thickness;
};

struct WorldOutputNode {};
struct LightOutputNode {};

// With a factor: what a Mix Shader is to the compiler. Kept in [0, 1].
struct MixShaderNode {
  Input<float> factor{0.5f};
};

struct AddShaderNode {};

}  // namespace

void register_output_nodes(NodeRegistry& registry) {
  registry.add<MaterialOutputNode>("ShaderNodeOutputMaterial")
      .closure_input("Surface")
      .closure_input("Volume")
      .input("Displacement", &MaterialOutputNode::displacement)
      .input("Thickness", &MaterialOutputNode::thickness);
  registry.add<WorldOutputNode>("ShaderNodeOutputWorld")
      .closure_input("Surface")
      .closure_input("Volume");
  registry.add<LightOutputNode>("ShaderNodeOutputLight").closure_input("Surface");
  registry.add<MixShaderNode>("ShaderNodeMixShader")
      .input("Fac", &MixShaderNode::factor)
      .closure_input("Shader")
      .closure_input("Shader_001")
      .closure_output("Shader");
  registry.add<AddShaderNode>("ShaderNodeAddShader")
      .closure_input("Shader")
      .closure_input("Shader_001")
      .closure_output("Shader");
}

}  // namespace tenniel
