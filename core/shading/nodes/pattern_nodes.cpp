// SPDX-License-Identifier: Apache-2.0
#include "shading/node_type.h"
#include "shading/nodes/cell_hash.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/patterns.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

// What every texture node has: a coordinate and the mapping that belongs to the node.
struct PatternNode {
  Input<Vec3> vector;
  std::vector<float> texture_mapping;

  Vec3 coordinate(const ShadingContext& context) const {
    return apply_texture_mapping(texture_mapping, context.get(vector));
  }
};

template <class Node>
NodeTypeBuilder<Node> add_pattern(NodeRegistry& registry, const char* idname) {
  auto builder = registry.add<Node>(idname);
  builder.input("Vector", static_cast<Input<Vec3> Node::*>(&Node::vector))
      .implicit(ImplicitInput::generated)
      .setting("texture_mapping", static_cast<std::vector<float> Node::*>(&Node::texture_mapping));
  return builder;
}

struct CheckerNode : PatternNode {
  Input<Spectrum> color1{Spectrum(0.8f)}, color2{Spectrum(0.2f)};
  Input<float> scale{5.0f};
  Output<Spectrum> color;
  Output<float> factor;

  void eval(ShadingContext& context) const {
    const float f = checker(coordinate(context) * context.get(scale));
    context.set(color, context.get(f == 1.0f ? color1 : color2));
    context.set(factor, f);
  }
};

struct GradientNode : PatternNode {
  Output<Spectrum> color;
  Output<float> factor;
  GradientType type = GradientType::linear;

  void eval(ShadingContext& context) const {
    const float f = gradient_pattern(type, coordinate(context));
    context.set(color, Spectrum(f));
    context.set(factor, f);
  }
};

struct WaveNode : PatternNode {
  Input<float> scale{5.0f}, distortion{0.0f}, detail{2.0f}, detail_scale{1.0f};
  Input<float> detail_roughness{0.5f}, phase{0.0f};
  Output<Spectrum> color;
  Output<float> factor;
  WaveType type = WaveType::bands;
  WaveDirection bands_direction = WaveDirection::x, rings_direction = WaveDirection::x;
  WaveProfile profile = WaveProfile::sine;

  void eval(ShadingContext& context) const {
    WaveParameters w;
    w.type = type;
    w.direction = type == WaveType::bands ? bands_direction : rings_direction;
    w.profile = profile;
    w.distortion = context.get(distortion);
    w.detail = context.get(detail);
    w.detail_scale = context.get(detail_scale);
    w.detail_roughness = context.get(detail_roughness);
    w.phase = context.get(phase);
    const float f = wave(coordinate(context) * context.get(scale), w);
    context.set(color, Spectrum(f));
    context.set(factor, f);
  }
};

struct MagicNode : PatternNode {
  Input<float> scale{5.0f}, distortion{1.0f};
  Output<Spectrum> color;
  Output<float> factor;
  int turbulence_depth = 2;

  void eval(ShadingContext& context) const {
    const Spectrum c =
        magic(coordinate(context), context.get(scale), turbulence_depth, context.get(distortion));
    context.set(color, c);
    context.set(factor, mean(c));
  }
};

struct BrickNode : PatternNode {
  Input<Spectrum> color1{Spectrum(0.8f)}, color2{Spectrum(0.2f)}, mortar{Spectrum(0.0f)};
  Input<float> scale{5.0f}, mortar_size{0.02f}, mortar_smooth{0.1f}, bias{0.0f};
  Input<float> brick_width{0.5f}, row_height{0.25f};
  Output<Spectrum> color;
  Output<float> factor;
  float offset = 0.5f, squash = 1.0f;
  int offset_frequency = 2, squash_frequency = 2;

  void eval(ShadingContext& context) const {
    BrickParameters b;
    b.mortar_size = context.get(mortar_size);
    b.mortar_smooth = context.get(mortar_smooth);
    b.bias = context.get(bias);
    b.width = context.get(brick_width);
    b.row_height = context.get(row_height);
    b.offset = offset;
    b.squash = squash;
    b.offset_frequency = offset_frequency;
    b.squash_frequency = squash_frequency;
    const BrickSample sample = brick(coordinate(context) * context.get(scale), b);
    if (color.used()) {
      const Spectrum face = lerp(context.get(color1), context.get(color2), sample.tint);
      context.set(color, lerp(face, context.get(mortar), sample.mortar));
    }
    context.set(factor, sample.mortar);
  }
};

enum class Dimensions : uint8_t { one, two, three, four };

struct WhiteNoiseNode {
  Input<Vec3> vector;
  Input<float> w;
  Output<float> value;
  Output<Spectrum> color;
  Dimensions dimensions = Dimensions::three;

  void eval(ShadingContext& context) const {
    const Vec3 p = context.get(vector);
    switch (dimensions) {
      case Dimensions::one:
        return answer(context, NoisePoint<1>{context.get(w)});
      case Dimensions::two:
        return answer(context, NoisePoint<2>{p.x, p.y});
      case Dimensions::three:
        return answer(context, NoisePoint<3>{p.x, p.y, p.z});
      case Dimensions::four:
        return answer(context, NoisePoint<4>{p.x, p.y, p.z, context.get(w)});
    }
  }

  template <size_t n>
  void answer(ShadingContext& context, const NoisePoint<n>& p) const {
    if (value.used()) context.set(value, random_of(p));
    if (color.used()) context.set(color, random_color_of(p));
  }
};

void register_wave(NodeRegistry& registry) {
  add_pattern<WaveNode>(registry, "ShaderNodeTexWave")
      .input("Scale", &WaveNode::scale)
      .input("Distortion", &WaveNode::distortion)
      .input("Detail", &WaveNode::detail)
      .input("Detail Scale", &WaveNode::detail_scale)
      .input("Detail Roughness", &WaveNode::detail_roughness)
      .input("Phase Offset", &WaveNode::phase)
      .output("Color", &WaveNode::color)
      .output("Fac", &WaveNode::factor)
      .choice("wave_type", &WaveNode::type,
              {{"BANDS", WaveType::bands}, {"RINGS", WaveType::rings}})
      .choice("bands_direction", &WaveNode::bands_direction,
              {{"X", WaveDirection::x},
               {"Y", WaveDirection::y},
               {"Z", WaveDirection::z},
               {"DIAGONAL", WaveDirection::diagonal}})
      .choice("rings_direction", &WaveNode::rings_direction,
              {{"X", WaveDirection::x},
               {"Y", WaveDirection::y},
               {"Z", WaveDirection::z},
               {"SPHERICAL", WaveDirection::diagonal}})
      .choice(
          "wave_profile", &WaveNode::profile,
          {{"SIN", WaveProfile::sine}, {"SAW", WaveProfile::saw}, {"TRI", WaveProfile::triangle}});
}

void register_brick(NodeRegistry& registry) {
  add_pattern<BrickNode>(registry, "ShaderNodeTexBrick")
      .input("Color1", &BrickNode::color1)
      .input("Color2", &BrickNode::color2)
      .input("Mortar", &BrickNode::mortar)
      .input("Scale", &BrickNode::scale)
      .input("Mortar Size", &BrickNode::mortar_size)
      .input("Mortar Smooth", &BrickNode::mortar_smooth)
      .input("Bias", &BrickNode::bias)
      .input("Brick Width", &BrickNode::brick_width)
      .input("Row Height", &BrickNode::row_height)
      .output("Color", &BrickNode::color)
      .output("Fac", &BrickNode::factor)
      .setting("offset", &BrickNode::offset)
      .setting("offset_frequency", &BrickNode::offset_frequency)
      .setting("squash", &BrickNode::squash)
      .setting("squash_frequency", &BrickNode::squash_frequency);
}

void register_gradient(NodeRegistry& registry) {
  add_pattern<GradientNode>(registry, "ShaderNodeTexGradient")
      .output("Color", &GradientNode::color)
      .output("Fac", &GradientNode::factor)
      .choice("gradient_type", &GradientNode::type,
              {{"LINEAR", GradientType::linear},
               {"QUADRATIC", GradientType::quadratic},
               {"EASING", GradientType::easing},
               {"DIAGONAL", GradientType::diagonal},
               {"SPHERICAL", GradientType::spherical},
               {"QUADRATIC_SPHERE", GradientType::quadratic_sphere},
               {"RADIAL", GradientType::radial}});
}

}  // namespace

void register_pattern_nodes(NodeRegistry& registry) {
  add_pattern<CheckerNode>(registry, "ShaderNodeTexChecker")
      .input("Color1", &CheckerNode::color1)
      .input("Color2", &CheckerNode::color2)
      .input("Scale", &CheckerNode::scale)
      .output("Color", &CheckerNode::color)
      .output("Fac", &CheckerNode::factor);
  register_gradient(registry);
  register_wave(registry);
  add_pattern<MagicNode>(registry, "ShaderNodeTexMagic")
      .input("Scale", &MagicNode::scale)
      .input("Distortion", &MagicNode::distortion)
      .output("Color", &MagicNode::color)
      .output("Fac", &MagicNode::factor)
      .setting("turbulence_depth", &MagicNode::turbulence_depth);
  register_brick(registry);
  // Blender implies no coordinate for this one.
  registry.add<WhiteNoiseNode>("ShaderNodeTexWhiteNoise")
      .input("Vector", &WhiteNoiseNode::vector)
      .input("W", &WhiteNoiseNode::w)
      .output("Value", &WhiteNoiseNode::value)
      .output("Color", &WhiteNoiseNode::color)
      .choice("noise_dimensions", &WhiteNoiseNode::dimensions,
              {{"1D", Dimensions::one},
               {"2D", Dimensions::two},
               {"3D", Dimensions::three},
               {"4D", Dimensions::four}});
  register_noise_nodes(registry);
}

}  // namespace tenniel
