// SPDX-License-Identifier: Apache-2.0
#include "shading/internal_nodes.h"

#include "math/numeric.h"
#include "shading/nodes/bump.h"

namespace tenniel {
namespace {

float convert(Spectrum from, float) {
  return luminance(from);
}
float convert(Vec3 from, float) {
  return (from.x + from.y + from.z) / 3.0f;
}
Vec3 convert(float from, Vec3) {
  return {from, from, from};
}
Vec3 convert(Spectrum from, Vec3) {
  return {from.r, from.g, from.b};
}
Spectrum convert(float from, Spectrum) {
  return Spectrum(from);
}
Spectrum convert(Vec3 from, Spectrum) {
  return {from.x, from.y, from.z};
}

template <class From, class To>
struct ConversionNode {
  Input<From> value;
  Output<To> result;
  void eval(ShadingContext& context) const {
    context.set(result, convert(context.get(value), To{}));
  }
};

template <class From, class To>
void add_conversion(NodeRegistry& registry, const char* name) {
  using Node = ConversionNode<From, To>;
  registry.add<Node>(name).input("value", &Node::value).output("result", &Node::result);
}

struct MixWeightsNode {
  Input<float> weight{1.0f};
  Input<float> factor;
  Output<float> first, second;
  void eval(ShadingContext& context) const {
    const float w = context.get(weight);
    const float t = saturate(context.get(factor));
    context.set(first, w * (1.0f - t));
    context.set(second, w * t);
  }
};

struct AddWeightsNode {
  Input<float> a, b;
  Output<float> sum;
  void eval(ShadingContext& context) const { context.set(sum, context.get(a) + context.get(b)); }
};

NodeRegistry make_registry() {
  NodeRegistry registry;
  add_conversion<Spectrum, float>(registry, "ColorToNumber");
  add_conversion<Vec3, float>(registry, "VectorToNumber");
  add_conversion<float, Vec3>(registry, "NumberToVector");
  add_conversion<Spectrum, Vec3>(registry, "ColorToVector");
  add_conversion<float, Spectrum>(registry, "NumberToColor");
  add_conversion<Vec3, Spectrum>(registry, "VectorToColor");
  registry.add<MixWeightsNode>("MixWeights")
      .input("weight", &MixWeightsNode::weight)
      .input("factor", &MixWeightsNode::factor)
      .output("first", &MixWeightsNode::first)
      .output("second", &MixWeightsNode::second);
  registry.add<AddWeightsNode>("AddWeights")
      .input("a", &AddWeightsNode::a)
      .input("b", &AddWeightsNode::b)
      .output("sum", &AddWeightsNode::sum);
  registry.add<DisplacementBumpNode>("DisplacementBump")
      .input("displacement", &DisplacementBumpNode::displacement)
      .varying();
  registry.add<DisplacedBumpNode>("DisplacedBump")
      .input("displacement", &DisplacedBumpNode::displacement)
      .varying();
  return registry;
}

const NodeType& internal_node(const char* name) {
  static const NodeRegistry registry = make_registry();
  return *registry.find(name);
}

}  // namespace

const NodeType& conversion_node(SocketType from, SocketType to) {
  static constexpr const char* k_names[3][3] = {
      {"", "NumberToVector", "NumberToColor"},
      {"VectorToNumber", "", "VectorToColor"},
      {"ColorToNumber", "ColorToVector", ""},
  };
  return internal_node(k_names[static_cast<size_t>(from)][static_cast<size_t>(to)]);
}

const NodeType& mix_weights_node() {
  return internal_node("MixWeights");
}
const NodeType& add_weights_node() {
  return internal_node("AddWeights");
}
const NodeType& displacement_bump_node(bool is_displaced) {
  return internal_node(is_displaced ? "DisplacedBump" : "DisplacementBump");
}

}  // namespace tenniel
