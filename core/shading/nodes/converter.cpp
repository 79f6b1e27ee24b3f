// SPDX-License-Identifier: Apache-2.0
#include "shading/node_type.h"
#include "shading/nodes/blackbody.h"
#include "shading/nodes/color.h"
#include "shading/nodes/ramp.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

enum class ColorModel : uint8_t { rgb, hsv, hsl };

Vec3 split(ColorModel model, Spectrum c) {
  switch (model) {
    case ColorModel::hsv:
      return rgb_to_hsv(c);
    case ColorModel::hsl:
      return rgb_to_hsl(c);
    case ColorModel::rgb:
      break;
  }
  return {c.r, c.g, c.b};
}

Spectrum join(ColorModel model, Vec3 v) {
  switch (model) {
    case ColorModel::hsv:
      return hsv_to_rgb(v);
    case ColorModel::hsl:
      return hsl_to_rgb(v);
    case ColorModel::rgb:
      break;
  }
  return {v.x, v.y, v.z};
}

struct SeparateColorNode {
  Input<Spectrum> color{Spectrum(0.8f)};
  Output<float> x, y, z;
  ColorModel mode = ColorModel::rgb;

  void eval(ShadingContext& context) const {
    const Vec3 parts = split(mode, context.get(color));
    context.set(x, parts.x);
    context.set(y, parts.y);
    context.set(z, parts.z);
  }
};

struct CombineColorNode {
  Input<float> x, y, z;
  Output<Spectrum> color;
  ColorModel mode = ColorModel::rgb;

  void eval(ShadingContext& context) const {
    context.set(color, join(mode, {context.get(x), context.get(y), context.get(z)}));
  }
};

// The older nodes with a fixed model.
struct SeparateHsvNode : SeparateColorNode {
  SeparateHsvNode() { mode = ColorModel::hsv; }
};
struct CombineHsvNode : CombineColorNode {
  CombineHsvNode() { mode = ColorModel::hsv; }
};

struct SeparateXyzNode {
  Input<Vec3> vector;
  Output<float> x, y, z;

  void eval(ShadingContext& context) const {
    const Vec3 v = context.get(vector);
    context.set(x, v.x);
    context.set(y, v.y);
    context.set(z, v.z);
  }
};

struct CombineXyzNode {
  Input<float> x, y, z;
  Output<Vec3> vector;

  void eval(ShadingContext& context) const {
    context.set(vector, {context.get(x), context.get(y), context.get(z)});
  }
};

struct RgbToBwNode {
  Input<Spectrum> color{Spectrum(0.5f)};
  Output<float> value;

  void eval(ShadingContext& context) const { context.set(value, luminance(context.get(color))); }
};

struct BlackbodyNode {
  Input<float> temperature{1500.0f};
  Output<Spectrum> color;

  void eval(ShadingContext& context) const {
    context.set(color, blackbody_color(context.get(temperature)));
  }
};

struct WavelengthNode {
  Input<float> wavelength{500.0f};
  Output<Spectrum> color;

  void eval(ShadingContext& context) const {
    context.set(color, wavelength_color(context.get(wavelength)));
  }
};

template <class Node>
auto add_separate(NodeRegistry& registry, const char* idname, const char* input, const char* x,
                  const char* y, const char* z) {
  return registry.add<Node>(idname)
      .input(input, static_cast<Input<Spectrum> Node::*>(&Node::color))
      .output(x, static_cast<Output<float> Node::*>(&Node::x))
      .output(y, static_cast<Output<float> Node::*>(&Node::y))
      .output(z, static_cast<Output<float> Node::*>(&Node::z));
}

template <class Node>
auto add_combine(NodeRegistry& registry, const char* idname, const char* x, const char* y,
                 const char* z, const char* output) {
  return registry.add<Node>(idname)
      .input(x, static_cast<Input<float> Node::*>(&Node::x))
      .input(y, static_cast<Input<float> Node::*>(&Node::y))
      .input(z, static_cast<Input<float> Node::*>(&Node::z))
      .output(output, static_cast<Output<Spectrum> Node::*>(&Node::color));
}

void register_color_parts(NodeRegistry& registry) {
  const auto models = {std::pair{"RGB", ColorModel::rgb}, std::pair{"HSV", ColorModel::hsv},
                       std::pair{"HSL", ColorModel::hsl}};
  add_separate<SeparateColorNode>(registry, "ShaderNodeSeparateColor", "Color", "Red", "Green",
                                  "Blue")
      .choice("mode", &SeparateColorNode::mode, models);
  add_combine<CombineColorNode>(registry, "ShaderNodeCombineColor", "Red", "Green", "Blue", "Color")
      .choice("mode", &CombineColorNode::mode, models);
  add_separate<SeparateColorNode>(registry, "ShaderNodeSeparateRGB", "Image", "R", "G", "B");
  add_combine<CombineColorNode>(registry, "ShaderNodeCombineRGB", "R", "G", "B", "Image");
  add_separate<SeparateHsvNode>(registry, "ShaderNodeSeparateHSV", "Color", "H", "S", "V");
  add_combine<CombineHsvNode>(registry, "ShaderNodeCombineHSV", "H", "S", "V", "Color");
}

}  // namespace

void register_converter_nodes(NodeRegistry& registry) {
  register_color_parts(registry);
  registry.add<SeparateXyzNode>("ShaderNodeSeparateXYZ")
      .input("Vector", &SeparateXyzNode::vector)
      .output("X", &SeparateXyzNode::x)
      .output("Y", &SeparateXyzNode::y)
      .output("Z", &SeparateXyzNode::z);
  registry.add<CombineXyzNode>("ShaderNodeCombineXYZ")
      .input("X", &CombineXyzNode::x)
      .input("Y", &CombineXyzNode::y)
      .input("Z", &CombineXyzNode::z)
      .output("Vector", &CombineXyzNode::vector);
  registry.add<RgbToBwNode>("ShaderNodeRGBToBW")
      .input("Color", &RgbToBwNode::color)
      .output("Val", &RgbToBwNode::value);
  registry.add<BlackbodyNode>("ShaderNodeBlackbody")
      .input("Temperature", &BlackbodyNode::temperature)
      .output("Color", &BlackbodyNode::color);
  registry.add<WavelengthNode>("ShaderNodeWavelength")
      .input("Wavelength", &WavelengthNode::wavelength)
      .output("Color", &WavelengthNode::color);
  register_ramp_nodes(registry);
}

}  // namespace tenniel
