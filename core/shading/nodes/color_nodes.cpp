// SPDX-License-Identifier: Apache-2.0
#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/color.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

enum class MixType : uint8_t { number, vector, color };
enum class FactorMode : uint8_t { uniform, non_uniform };

struct MixNode {
  Input<float> factor{0.5f};
  Input<Vec3> factor_v{{0.5f, 0.5f, 0.5f}};
  Input<float> a, b;
  Input<Vec3> a_v, b_v;
  Input<Spectrum> a_c{Spectrum(0.5f)}, b_c{Spectrum(0.5f)};
  Output<float> result;
  Output<Vec3> result_v;
  Output<Spectrum> result_c;
  MixType data_type = MixType::number;
  FactorMode factor_mode = FactorMode::uniform;
  BlendMode blend_type = BlendMode::mix;
  bool clamp_factor = true, clamp_result = false;

  float limited(float t) const { return clamp_factor ? saturate(t) : t; }

  void eval(ShadingContext& context) const {
    switch (data_type) {
      case MixType::number:
        return context.set(result,
                           lerp(context.get(a), context.get(b), limited(context.get(factor))));
      case MixType::vector:
        return context.set(result_v, mix_vector(context));
      case MixType::color: {
        const Spectrum mixed =
            mix_color(blend_type, context.get(a_c), context.get(b_c), limited(context.get(factor)));
        return context.set(result_c, clamp_result ? saturate(mixed) : mixed);
      }
    }
  }

  Vec3 mix_vector(const ShadingContext& context) const {
    const Vec3 from = context.get(a_v), to = context.get(b_v);
    Vec3 t;
    if (factor_mode == FactorMode::non_uniform)
      t = context.get(factor_v);
    else
      t.x = t.y = t.z = context.get(factor);
    return {lerp(from.x, to.x, limited(t.x)), lerp(from.y, to.y, limited(t.y)),
            lerp(from.z, to.z, limited(t.z))};
  }
};

struct MixRgbNode {
  Input<float> factor{0.5f};
  Input<Spectrum> a{Spectrum(0.5f)}, b{Spectrum(0.5f)};
  Output<Spectrum> color;
  BlendMode blend_type = BlendMode::mix;
  bool use_clamp = false;

  void eval(ShadingContext& context) const {
    const Spectrum mixed =
        mix_color(blend_type, context.get(a), context.get(b), saturate(context.get(factor)));
    context.set(color, use_clamp ? saturate(mixed) : mixed);
  }
};

struct InvertNode {
  Input<float> factor{1.0f};
  Input<Spectrum> color;
  Output<Spectrum> result;

  void eval(ShadingContext& context) const {
    context.set(result, invert_color(context.get(color), context.get(factor)));
  }
};

struct HueSaturationNode {
  Input<float> hue{0.5f}, saturation{1.0f}, value{1.0f}, factor{1.0f};
  Input<Spectrum> color{Spectrum(0.8f)};
  Output<Spectrum> result;

  void eval(ShadingContext& context) const {
    context.set(result, adjust_hue(context.get(color), context.get(hue), context.get(saturation),
                                   context.get(value), context.get(factor)));
  }
};

struct GammaNode {
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> gamma{1.0f};
  Output<Spectrum> result;

  void eval(ShadingContext& context) const {
    context.set(result, gamma_color(context.get(color), context.get(gamma)));
  }
};

struct BrightContrastNode {
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> brightness, contrast;
  Output<Spectrum> result;

  void eval(ShadingContext& context) const {
    context.set(result, brightness_contrast(context.get(color), context.get(brightness),
                                            context.get(contrast)));
  }
};

template <class Node>
void add_blend_choice(NodeTypeBuilder<Node>& builder) {
  builder.choice("blend_type", &Node::blend_type,
                 {{"MIX", BlendMode::mix},
                  {"DARKEN", BlendMode::darken},
                  {"MULTIPLY", BlendMode::multiply},
                  {"BURN", BlendMode::burn},
                  {"LIGHTEN", BlendMode::lighten},
                  {"SCREEN", BlendMode::screen},
                  {"DODGE", BlendMode::dodge},
                  {"ADD", BlendMode::add},
                  {"OVERLAY", BlendMode::overlay},
                  {"SOFT_LIGHT", BlendMode::soft_light},
                  {"LINEAR_LIGHT", BlendMode::linear_light},
                  {"DIFFERENCE", BlendMode::difference},
                  {"SUBTRACT", BlendMode::subtract},
                  {"DIVIDE", BlendMode::divide},
                  {"HUE", BlendMode::hue},
                  {"SATURATION", BlendMode::saturation},
                  {"COLOR", BlendMode::color},
                  {"VALUE", BlendMode::value}});
}

void register_mix(NodeRegistry& registry) {
  auto mix =
      registry.add<MixNode>("ShaderNodeMix")
          .input("Factor_Float", &MixNode::factor)
          .input("Factor_Vector", &MixNode::factor_v)
          .input("A_Float", &MixNode::a)
          .input("B_Float", &MixNode::b)
          .input("A_Vector", &MixNode::a_v)
          .input("B_Vector", &MixNode::b_v)
          .input("A_Color", &MixNode::a_c)
          .input("B_Color", &MixNode::b_c)
          .output("Result_Float", &MixNode::result)
          .output("Result_Vector", &MixNode::result_v)
          .output("Result_Color", &MixNode::result_c)
          .setting("clamp_factor", &MixNode::clamp_factor)
          .setting("clamp_result", &MixNode::clamp_result)
          .choice(
              "data_type", &MixNode::data_type,
              {{"FLOAT", MixType::number}, {"VECTOR", MixType::vector}, {"RGBA", MixType::color}})
          .choice("factor_mode", &MixNode::factor_mode,
                  {{"UNIFORM", FactorMode::uniform}, {"NON_UNIFORM", FactorMode::non_uniform}});
  add_blend_choice(mix);
  auto mix_rgb = registry.add<MixRgbNode>("ShaderNodeMixRGB")
                     .input("Fac", &MixRgbNode::factor)
                     .input("Color1", &MixRgbNode::a)
                     .input("Color2", &MixRgbNode::b)
                     .output("Color", &MixRgbNode::color)
                     .setting("use_clamp", &MixRgbNode::use_clamp);
  add_blend_choice(mix_rgb);
}

}  // namespace

void register_color_nodes(NodeRegistry& registry) {
  register_mix(registry);
  registry.add<InvertNode>("ShaderNodeInvert")
      .input("Fac", &InvertNode::factor)
      .input("Color", &InvertNode::color)
      .output("Color", &InvertNode::result);
  registry.add<HueSaturationNode>("ShaderNodeHueSaturation")
      .input("Hue", &HueSaturationNode::hue)
      .input("Saturation", &HueSaturationNode::saturation)
      .input("Value", &HueSaturationNode::value)
      .input("Fac", &HueSaturationNode::factor)
      .input("Color", &HueSaturationNode::color)
      .output("Color", &HueSaturationNode::result);
  registry.add<GammaNode>("ShaderNodeGamma")
      .input("Color", &GammaNode::color)
      .input("Gamma", &GammaNode::gamma)
      .output("Color", &GammaNode::result);
  registry.add<BrightContrastNode>("ShaderNodeBrightContrast")
      .input("Color", &BrightContrastNode::color)
      .input("Bright", &BrightContrastNode::brightness)
      .input("Contrast", &BrightContrastNode::contrast)
      .output("Color", &BrightContrastNode::result);
}

}  // namespace tenniel
