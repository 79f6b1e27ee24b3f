// SPDX-License-Identifier: Apache-2.0
// Principled Hair BSDF, with the meaning that its inputs have in Blender 3.4.
#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/nodes/attributes.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

enum class HairColoring : uint8_t { absorption, melanin, color };

// What melanin adds up to at most.
constexpr float k_least_bleached = 1e-4f;

// Where the viewer's ray meets the hair, along y of the frame: -1 and 1 are its rims.
float hair_offset(const SurfaceInteraction& at, const Frame& frame) {
  if (at.mesh && at.mesh->shape == Shape::ribbons) return -at.v;
  return dot(frame.y, at.geometric_normal);
}

struct PrincipledHairNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum{0.017513f, 0.005763f, 0.002059f}}, tint{Spectrum(1.0f)};
  Input<Vec3> absorption{{0.245531f, 0.52f, 1.365f}};
  Input<float> melanin{0.8f}, melanin_redness{1.0f}, roughness{0.3f}, radial_roughness{0.3f};
  Input<float> coat{0.0f}, ior{1.55f}, offset{0.03490658f};
  Input<float> random_color{0.0f}, random_roughness{0.0f}, random{0.0f};
  HairColoring coloring = HairColoring::color;
  AttributeSlot strand_random{k_strand_random};

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& at = context.surface;
    const Vec3 along = at.mesh ? parametric_u_direction(at) : Vec3{1.0f, 0.0f, 0.0f};
    const Vec3 toward = at.wo - along * safe_divide(dot(at.wo, along), length_squared(along));
    const Vec3 z = normalize_or(toward, at.geometric_normal);
    const Frame frame = Frame::from_normal_tangent(z, along);

    // Every hair lies somewhere within half the random share to either side.
    const float chance = 2.0f * (random_of(context) - 0.5f);
    const float rougher = 1.0f + chance * context.get(random_roughness);
    const float around = context.get(radial_roughness) * rougher;
    HairFiber fiber =
        HairFiber::from_roughness(context.get(roughness) * rougher, around, context.get(coat));
    fiber.absorption = absorption_of(context, chance, around);
    fiber.tilt = context.get(offset);
    fiber.eta = context.get(ior);
    fiber.offset = hair_offset(at, frame);
    const Spectrum share(context.get(weight));
    for (const bool is_primary : {true, false}) {
      fiber.is_primary = is_primary;
      context.bsdf.add(fiber, share, z, along);
    }
  }
  uint8_t closure_parts() const { return k_query_scatter; }

  float random_of(const ShadingContext& context) const {
    if (random.linked()) return context.get(random);
    const auto own = mesh_attribute(context, strand_random.id);
    return own ? (*own)[0] : random.value;
  }

  Spectrum absorption_of(const ShadingContext& context, float chance, float around) const {
    if (coloring == HairColoring::absorption) {
      const Vec3 sigma = context.get(absorption);
      return {sigma.x, sigma.y, sigma.z};
    }
    if (coloring == HairColoring::color)
      return HairFiber::absorption_of(context.get(color), around);
    const float share =
        context.get(melanin) * (1.0f + chance * saturate(context.get(random_color)));
    const float amount = -std::log(std::max(1.0f - share, k_least_bleached));
    const float red = context.get(melanin_redness);
    return HairFiber::absorption_of_melanin(amount * (1.0f - red), amount * red) +
           HairFiber::absorption_of(context.get(tint), around);
  }
};

}  // namespace

void register_principled_hair(NodeRegistry& registry) {
  registry.add<PrincipledHairNode>("ShaderNodeBsdfHairPrincipled")
      .input("Color", &PrincipledHairNode::color)
      .input("Melanin", &PrincipledHairNode::melanin)
      .input("Melanin Redness", &PrincipledHairNode::melanin_redness)
      .input("Tint", &PrincipledHairNode::tint)
      .input("Absorption Coefficient", &PrincipledHairNode::absorption)
      .input("Roughness", &PrincipledHairNode::roughness)
      .input("Radial Roughness", &PrincipledHairNode::radial_roughness)
      .input("Coat", &PrincipledHairNode::coat)
      .input("IOR", &PrincipledHairNode::ior)
      .input("Offset", &PrincipledHairNode::offset)
      .input("Random Color", &PrincipledHairNode::random_color)
      .input("Random Roughness", &PrincipledHairNode::random_roughness)
      .input("Random", &PrincipledHairNode::random)
      .choice("parametrization", &PrincipledHairNode::coloring,
              {{"ABSORPTION", HairColoring::absorption},
               {"MELANIN", HairColoring::melanin},
               {"COLOR", HairColoring::color}})
      .setting("strand_random", &PrincipledHairNode::strand_random)
      .closure_output("BSDF")
      .closure();
}

}  // namespace tenniel
