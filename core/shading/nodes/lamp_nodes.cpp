// SPDX-License-Identifier: Apache-2.0
// Nodes that are made for lamps.
#include <cmath>
#include <memory>

#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/ies_profile.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

// A lamp's light falls with the square of the distance by itself; these take that back.
struct LightFalloffNode {
  Input<float> strength{100.0f}, smooth{0.0f};
  Output<float> quadratic, linear, constant;

  void eval(ShadingContext& context) const {
    const float t = context.surface.t, k = context.get(smooth);
    float s = context.get(strength);
    // The square overflows for a sun.
    if (k > 0.0f && std::isfinite(t * t)) s *= t * t / (k + t * t);
    context.set(quadratic, s);
    context.set(linear, s * t);
    context.set(constant, s * t * t);
  }
};

struct IesTextureNode {
  Input<Vec3> vector;
  Input<float> strength{1.0f};
  Output<float> factor;
  std::vector<float> texture_mapping;
  std::string text;  // the file itself
  std::shared_ptr<const IesProfile> profile;

  void prepare() { profile = std::make_shared<const IesProfile>(text); }
  void eval(ShadingContext& context) const {
    const Vec3 direction = apply_texture_mapping(texture_mapping, context.get(vector));
    context.set(factor, context.get(strength) * profile->intensity(direction));
  }
};

}  // namespace

void register_lamp_nodes(NodeRegistry& registry) {
  registry.add<LightFalloffNode>("ShaderNodeLightFalloff")
      .input("Strength", &LightFalloffNode::strength)
      .input("Smooth", &LightFalloffNode::smooth)
      .output("Quadratic", &LightFalloffNode::quadratic)
      .output("Linear", &LightFalloffNode::linear)
      .output("Constant", &LightFalloffNode::constant)
      .varying();
  registry.add<IesTextureNode>("ShaderNodeTexIES")
      .input("Vector", &IesTextureNode::vector)
      .implicit(ImplicitInput::object_normal)
      .input("Strength", &IesTextureNode::strength)
      .output("Fac", &IesTextureNode::factor)
      .setting("texture_mapping", &IesTextureNode::texture_mapping)
      .setting("text", &IesTextureNode::text);
}

}  // namespace tenniel
