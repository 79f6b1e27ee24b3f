// SPDX-License-Identifier: Apache-2.0
#include "shading/node_type.h"
#include "shading/nodes/register.h"

namespace tenniel {
namespace {

// A root of the tree as an output is, and run as a closure: for its effect alone.
struct AovOutputNode {
  Input<Spectrum> color;
  Input<float> value;
  Input<float> weight{1.0f};
  AovSlot pass;

  uint8_t closure_parts() const { return pass.channel >= 0 ? k_query_aov : 0; }

  void eval(ShadingContext& context) const {
    if (!context.aovs) return;
    float* at = context.aovs + pass.channel;
    if (!pass.is_color) {
      at[0] += context.get(value);
      return;
    }
    const Spectrum c = context.get(color);
    at[0] += c.r;
    at[1] += c.g;
    at[2] += c.b;
    at[3] += 1.0f;
  }
};

}  // namespace

void register_aov_nodes(NodeRegistry& registry) {
  registry.add<AovOutputNode>("ShaderNodeOutputAOV")
      .input("Color", &AovOutputNode::color)
      .input("Value", &AovOutputNode::value)
      .setting("aov_name", &AovOutputNode::pass)
      .closure();
}

}  // namespace tenniel
