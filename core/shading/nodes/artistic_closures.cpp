// SPDX-License-Identifier: Apache-2.0
// Toon and Hair: shaders that draw rather than imitate.
#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

enum class ToonComponent : uint8_t { diffuse, glossy };

struct ToonNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> size{0.5f}, smooth{0.0f};
  Input<Vec3> normal;
  ToonComponent component = ToonComponent::diffuse;

  void eval(ShadingContext& context) const {
    const ToonCone cone{context.get(size), context.get(smooth)};
    const Lobe lobe =
        component == ToonComponent::diffuse ? Lobe(DiffuseToon{cone}) : Lobe(GlossyToon{cone});
    context.bsdf.add(lobe, context.get(color) * context.get(weight), context.normal(normal));
  }
  uint8_t closure_parts() const { return k_query_scatter; }
};

enum class HairComponent : uint8_t { reflection, transmission };

struct HairNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> offset{0.0f}, roughness_u{0.1f}, roughness_v{1.0f};
  Input<Vec3> tangent;
  HairComponent component = HairComponent::reflection;

  void eval(ShadingContext& context) const {
    const Vec3 n = context.closure_normal;
    const bool has_strand = tangent.linked() || is_on_hair(context.surface);
    // A face has no strand: it lies along its parametrisation, and the offset is left out.
    const Vec3 along = tangent.linked() ? context.get(tangent) : side_of(context.surface);
    const Vec3 strand = normalize_or(along, {});
    HairLobe lobe{context.get(roughness_u), context.get(roughness_v)};
    lobe.offset = has_strand ? -context.get(offset) : 0.0f;
    lobe.tilt = dot(strand, n);
    lobe.is_transmission = component == HairComponent::transmission;
    lobe.is_round = is_on_hair(context.surface);
    context.bsdf.add(lobe, context.get(color) * context.get(weight), n, strand);
  }
  uint8_t closure_parts() const { return k_query_scatter; }

  static Vec3 side_of(const SurfaceInteraction& surface) {
    if (is_on_hair(surface)) return strand_direction(surface);
    return surface.mesh ? parametric_v_direction(surface) : Vec3{};
  }
};

}  // namespace

void register_artistic_closures(NodeRegistry& registry) {
  registry.add<ToonNode>("ShaderNodeBsdfToon")
      .input("Color", &ToonNode::color)
      .input("Size", &ToonNode::size)
      .input("Smooth", &ToonNode::smooth)
      .input("Normal", &ToonNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("component", &ToonNode::component,
              {{"DIFFUSE", ToonComponent::diffuse}, {"GLOSSY", ToonComponent::glossy}})
      .closure_output("BSDF")
      .closure();
  registry.add<HairNode>("ShaderNodeBsdfHair")
      .input("Color", &HairNode::color)
      .input("Offset", &HairNode::offset)
      .input("RoughnessU", &HairNode::roughness_u)
      .input("RoughnessV", &HairNode::roughness_v)
      .input("Tangent", &HairNode::tangent)
      .implicit(ImplicitInput::tangent)
      .choice("component", &HairNode::component,
              {{"Reflection", HairComponent::reflection},
               {"Transmission", HairComponent::transmission}})
      .closure_output("BSDF")
      .closure();
}

}  // namespace tenniel
