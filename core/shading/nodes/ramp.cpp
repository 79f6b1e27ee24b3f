// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/ramp.h"

#include "shading/node_type.h"

namespace tenniel {

namespace {

enum class RampInterpolation : uint8_t { ease, cardinal, linear, b_spline, constant };

struct ColorRampNode {
  Input<float> factor{0.5f};
  Output<Spectrum> color;
  Output<float> alpha;
  std::vector<float> color_ramp;  // (256, 4) linear RGBA, baked at i / 255
  RampInterpolation interpolation = RampInterpolation::linear;

  void eval(ShadingContext& context) const {
    const bool interpolate = interpolation != RampInterpolation::constant;
    const auto rgba = lookup_table<4>(color_ramp, context.get(factor), interpolate, false);
    context.set(color, {rgba[0], rgba[1], rgba[2]});
    context.set(alpha, rgba[3]);
  }
};

// What the curve nodes share: tables of each channel over [min_x, max_x].
struct CurveTable {
  std::vector<float> samples;
  float min_x = 0.0f, max_x = 1.0f;
  bool extrapolate = true;

  template <size_t channels>
  float at(float x, size_t channel) const {
    const float position = safe_divide(x - min_x, max_x - min_x);
    return lookup_table<channels>(samples, position, true, extrapolate)[channel];
  }
};

struct RgbCurveNode : CurveTable {
  Input<float> factor{1.0f};
  Input<Spectrum> color{Spectrum(1.0f)};
  Output<Spectrum> result;

  void eval(ShadingContext& context) const {
    const Spectrum c = context.get(color);
    const Spectrum curved = {at<3>(c.r, 0), at<3>(c.g, 1), at<3>(c.b, 2)};
    context.set(result, lerp(c, curved, context.get(factor)));
  }
};

struct VectorCurveNode : CurveTable {
  Input<float> factor{1.0f};
  Input<Vec3> vector;
  Output<Vec3> result;

  void eval(ShadingContext& context) const {
    const Vec3 v = context.get(vector);
    const Vec3 curved = {at<3>(v.x, 0), at<3>(v.y, 1), at<3>(v.z, 2)};
    const float t = context.get(factor);
    context.set(result, v * (1.0f - t) + curved * t);
  }
};

struct FloatCurveNode : CurveTable {
  Input<float> factor{1.0f}, value{1.0f};
  Output<float> result;

  void eval(ShadingContext& context) const {
    const float x = context.get(value);
    context.set(result, lerp(x, at<1>(x, 0), context.get(factor)));
  }
};

// The exporter bakes `mapping` into a table and gives the range with it.
template <class Node>
void add_curve_settings(NodeTypeBuilder<Node> builder) {
  builder.setting("mapping", static_cast<std::vector<float> Node::*>(&Node::samples))
      .setting("min_x", static_cast<float Node::*>(&Node::min_x))
      .setting("max_x", static_cast<float Node::*>(&Node::max_x))
      .setting("extrapolate", static_cast<bool Node::*>(&Node::extrapolate));
}

}  // namespace

void register_ramp_nodes(NodeRegistry& registry) {
  registry.add<ColorRampNode>("ShaderNodeValToRGB")
      .input("Fac", &ColorRampNode::factor)
      .output("Color", &ColorRampNode::color)
      .output("Alpha", &ColorRampNode::alpha)
      .setting("color_ramp", &ColorRampNode::color_ramp)
      .choice("interpolation", &ColorRampNode::interpolation,
              {{"EASE", RampInterpolation::ease},
               {"CARDINAL", RampInterpolation::cardinal},
               {"LINEAR", RampInterpolation::linear},
               {"B_SPLINE", RampInterpolation::b_spline},
               {"CONSTANT", RampInterpolation::constant}});
  add_curve_settings(registry.add<RgbCurveNode>("ShaderNodeRGBCurve")
                         .input("Fac", &RgbCurveNode::factor)
                         .input("Color", &RgbCurveNode::color)
                         .output("Color", &RgbCurveNode::result));
  add_curve_settings(registry.add<VectorCurveNode>("ShaderNodeVectorCurve")
                         .input("Fac", &VectorCurveNode::factor)
                         .input("Vector", &VectorCurveNode::vector)
                         .output("Vector", &VectorCurveNode::result));
  add_curve_settings(registry.add<FloatCurveNode>("ShaderNodeFloatCurve")
                         .input("Factor", &FloatCurveNode::factor)
                         .input("Value", &FloatCurveNode::value)
                         .output("Value", &FloatCurveNode::result));
}

}  // namespace tenniel
