// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/subsurface.h"

#include <algorithm>

#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

// Of Blender: beyond them the fits that the methods rest on have no meaning.
constexpr float k_min_ior = 1.01f, k_max_ior = 3.8f;
constexpr float k_max_subsurface_anisotropy = 0.9f;

// The part of `weight` that goes below the surface, added; what is left is returned.
Spectrum add_below(ShadingContext& context, const SubsurfaceRequest& request, Spectrum weight,
                   bool has_fresnel) {
  Subsurface lobe;
  lobe.method = request.method;
  lobe.has_fresnel = has_fresnel;
  lobe.color = request.color;
  lobe.anisotropy = std::clamp(request.anisotropy, 0.0f, k_max_subsurface_anisotropy);
  const float ior = std::clamp(request.ior, k_min_ior, k_max_ior);
  // Strands and points have no inside to walk through.
  const Mesh* mesh = context.surface.mesh;
  const bool has_inside = mesh != nullptr && mesh->shape == Shape::faces;
  Spectrum at_surface;
  const auto part = [&](float radius, float color, float& below, float& rest, float& length) {
    if (has_inside && radius >= k_min_subsurface_radius) {
      length = radius * subsurface_radius_scale(request.method, color, ior);
    } else {
      rest = below;
      below = 0.0f;
    }
  };
  part(request.radius.x, request.color.r, weight.r, at_surface.r, lobe.radius.r);
  part(request.radius.y, request.color.g, weight.g, at_surface.g, lobe.radius.g);
  part(request.radius.z, request.color.b, weight.b, at_surface.b, lobe.radius.b);
  context.bsdf.add(lobe, weight, request.normal);
  return at_surface;
}

struct SubsurfaceNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> scale{1.0f};
  Input<Vec3> radius{{1.0f, 0.2f, 0.1f}};
  Input<float> ior{1.4f}, anisotropy{0.0f};
  Input<Vec3> normal;
  SubsurfaceMethod falloff = SubsurfaceMethod::random_walk;

  void eval(ShadingContext& context) const {
    const Spectrum tint = context.get(color);
    // Behind a diffuse bounce nobody sees it, and it would be noise.
    const float size = context.path.has_diffuse_ancestor ? 0.0f : context.get(scale);
    add_subsurface(context,
                   {falloff, tint, context.get(radius) * size, context.get(ior),
                    context.get(anisotropy), context.normal(normal)},
                   tint * context.get(weight));
  }
  uint8_t closure_parts() const { return k_query_scatter; }
  bool has_subsurface() const { return scale.linked() || scale.value != 0.0f; }
};

}  // namespace

void add_subsurface(ShadingContext& context, const SubsurfaceRequest& request, Spectrum weight) {
  const Spectrum rest = add_below(context, request, weight, false);
  context.bsdf.add(Diffuse{}, rest, request.normal);
}

void add_subsurface(ShadingContext& context, const SubsurfaceRequest& request, Spectrum weight,
                    float roughness) {
  using Terms = PrincipledDiffuseTerms;
  context.bsdf.add(PrincipledDiffuse{roughness, Terms::retro_reflection}, weight, request.normal);
  const Spectrum rest = add_below(context, request, weight, true);
  context.bsdf.add(PrincipledDiffuse{roughness, Terms::lambert}, rest, request.normal);
}

void register_subsurface_nodes(NodeRegistry& registry) {
  using Node = SubsurfaceNode;
  registry.add<Node>("ShaderNodeSubsurfaceScattering")
      .input("Color", &Node::color)
      .input("Scale", &Node::scale)
      .input("Radius", &Node::radius)
      .input("IOR", &Node::ior)
      .input("Anisotropy", &Node::anisotropy)
      .input("Normal", &Node::normal)
      .implicit(ImplicitInput::normal)
      .choice("falloff", &Node::falloff,
              {{"BURLEY", SubsurfaceMethod::christensen_burley},
               {"RANDOM_WALK_FIXED_RADIUS", SubsurfaceMethod::fixed_radius_walk},
               {"RANDOM_WALK", SubsurfaceMethod::random_walk}})
      .closure_output("BSSRDF")
      .closure();
}

}  // namespace tenniel
