// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/principled.h"

#include <algorithm>

#include "bsdf/fresnel.h"
#include "math/numeric.h"
#include "shading/nodes/closures.h"
#include "shading/nodes/register.h"
#include "shading/nodes/subsurface.h"
#include "shading/surface_tangent.h"

namespace tenniel {
namespace {

constexpr float k_weight_cutoff = 1e-5f;
constexpr float k_min_transmittance = 1e-4f;

// The hue of `color`: what it is at brightness 1.
Spectrum tint_of(Spectrum color, float brightness) {
  return brightness > 0.0f ? color / brightness : Spectrum(1.0f);
}

// Values of one evaluation, so that each lobe below reads as its formula.
struct Principled {
  ShadingContext& context;
  Vec3 normal;
  Spectrum base;
  float weight;  // of the whole shader
  float roughness;
  float diffuse_weight, transmission_weight;

  template <class L>
  void add(const L& lobe, Spectrum factor) const {
    context.bsdf.add(lobe, factor * weight, normal);
  }

  void add_diffuse() const {
    if (diffuse_weight > k_weight_cutoff) add(PrincipledDiffuse{roughness}, base * diffuse_weight);
  }

  void add_sheen(float sheen, float tint) const {
    if (diffuse_weight <= k_weight_cutoff || sheen <= k_weight_cutoff) return;
    const Spectrum color = lerp(Spectrum(1.0f), tint_of(base, luminance(base)), tint);
    add(PrincipledSheen{}, color * (sheen * diffuse_weight));
  }

  void add_transmission(float ior, float specular_tint, float refraction_roughness,
                        bool walks) const {
    if (transmission_weight <= k_weight_cutoff) return;
    const float eta = relative_ior(context.surface, ior);
    const float reflectance = fresnel_dielectric(dot(normal, context.surface.wo), eta);
    const Spectrum cspec0 = lerp(Spectrum(1.0f), base, specular_tint);
    const auto rough = [](float r) {
      return Microsurface{MicrofacetDistribution::ggx, sqr(r), sqr(r)};
    };
    if (walks) {
      MultiScatter scatter{sqr(roughness), sqr(roughness), eta};
      scatter.reflecting = Fresnel::principled(cspec0, eta);
      scatter.passing = base;
      scatter.seed = walk_seed(context.surface);
      add(MultiGgxReflection{scatter}, Spectrum(transmission_weight));
      return add(MultiGgxTransmission{scatter}, Spectrum(transmission_weight));
    }
    add(MicrofacetReflection{rough(roughness), Fresnel::principled(cspec0, eta)},
        Spectrum(transmission_weight * reflectance));
    add(MicrofacetRefraction{rough(refraction_roughness), eta},
        base * (transmission_weight * std::max(1.0f - reflectance, k_min_transmittance)));
  }
};

}  // namespace

Vec3 PrincipledV1Node::turned_tangent(const ShadingContext& context, Vec3 n) const {
  const Vec3 along = tangent.linked() ? context.get(tangent) : surface_tangent(context.surface, n);
  return rotate_about(along, n, k_two_pi * context.get(anisotropic_rotation));
}

void PrincipledV1Node::eval(ShadingContext& context) const {
  const float opacity = saturate(context.get(alpha)) * context.get(weight);
  if (context.query & k_query_transparency)
    context.transparency += Spectrum(context.get(weight) - opacity);
  if (context.query & k_query_emission)
    context.add_emission(context.get(emission) * (context.get(emission_strength) * opacity));
  if ((context.query & k_query_scatter) && opacity > 0.0f) scatter(context, opacity);
}

void PrincipledV1Node::scatter(ShadingContext& context, float opacity) const {
  const float metal = saturate(context.get(metallic));
  const float glass = saturate(context.get(transmission));
  const float rough = saturate(context.get(roughness));
  Spectrum base = context.get(base_color);
  const Vec3 n = context.normal(normal);
  const float share = context.get(subsurface);
  const Spectrum mixed = lerp(base, context.get(subsurface_color), share);
  // Behind a diffuse bounce nobody sees what is below, and it would be noise.
  const bool is_deep = share > k_weight_cutoff && !context.path.has_diffuse_ancestor;
  if (context.path.has_diffuse_ancestor) base = mixed;
  const Principled p{
      context, n, base, opacity, rough, (1.0f - metal) * (1.0f - glass), glass * (1.0f - metal)};
  if (is_deep)
    add_subsurface(context,
                   {subsurface_method, mixed, context.get(subsurface_radius) * share,
                    context.get(subsurface_ior), context.get(subsurface_anisotropy), n},
                   mixed * (p.diffuse_weight * opacity), rough);
  else
    p.add_diffuse();
  p.add_sheen(context.get(sheen), context.get(sheen_tint));

  const float spec = std::max(context.get(specular), 0.0f);
  const float specular_weight = 1.0f - p.transmission_weight;
  if (specular_weight > k_weight_cutoff && (spec > k_weight_cutoff || metal > k_weight_cutoff)) {
    const float brightness = 0.3f * base.r + 0.6f * base.g + 0.1f * base.b;
    const Spectrum tint =
        lerp(Spectrum(1.0f), tint_of(base, brightness), context.get(specular_tint));
    const Spectrum cspec0 = lerp(tint * (0.08f * spec), base, metal);
    const float lobe_ior = 2.0f / (1.0f - safe_sqrt(std::min(0.08f * spec, 0.99f))) - 1.0f;
    const float stretch = saturate(context.get(anisotropic));
    const float aspect = safe_sqrt(1.0f - stretch * 0.9f);
    const float alpha_x = sqr(rough) / aspect, alpha_y = sqr(rough) * aspect;
    const Fresnel fresnel = Fresnel::principled(cspec0, lobe_ior);
    // A smooth surface has hardly a second bounce: Blender leaves the walk out below these.
    Lobe lobe = MicrofacetReflection{{MicrofacetDistribution::ggx, alpha_x, alpha_y}, fresnel};
    if (distribution == PrincipledDistribution::multi_ggx && rough > 0.075f) {
      MultiScatter scatter{alpha_x, alpha_y};
      scatter.reflecting = fresnel;
      scatter.seed = walk_seed(context.surface);
      lobe = MultiGgxReflection{scatter};
    }
    if (stretch > 0.0f)
      context.bsdf.add(lobe, Spectrum(specular_weight * opacity), n, turned_tangent(context, n));
    else
      p.add(lobe, Spectrum(specular_weight));
  }

  // Blender offers Transmission Roughness with the GGX distribution only.
  const float extra = distribution == PrincipledDistribution::ggx
                          ? saturate(context.get(transmission_roughness))
                          : 0.0f;
  p.add_transmission(context.get(ior), context.get(specular_tint),
                     1.0f - (1.0f - rough) * (1.0f - extra),
                     distribution == PrincipledDistribution::multi_ggx && rough > 0.05f);

  const float coat = context.get(clearcoat);
  if (coat > k_weight_cutoff)
    context.bsdf.add(Clearcoat{sqr(saturate(context.get(clearcoat_roughness)))},
                     Spectrum(0.25f * coat * opacity), context.normal(clearcoat_normal));
}

uint8_t PrincipledV1Node::closure_parts() const {
  const bool shows = alpha.linked() || alpha.value > 0.0f;
  const bool passes = alpha.linked() || alpha.value < 1.0f;
  const bool emits = (emission.linked() || !is_black(emission.value)) &&
                     (emission_strength.linked() || emission_strength.value != 0.0f);
  return static_cast<uint8_t>((shows ? k_query_scatter : 0) |
                              (shows && emits ? k_query_emission : 0) |
                              (passes ? k_query_transparency : 0));
}

void register_principled_nodes(NodeRegistry& registry) {
  using Node = PrincipledV1Node;
  constexpr uint8_t scatter = k_query_scatter, emission = k_query_emission;
  registry.add<Node>("ShaderNodeBsdfPrincipled")
      .input("Base Color", &Node::base_color, scatter)
      .input("Subsurface", &Node::subsurface, scatter)
      .input("Subsurface Radius", &Node::subsurface_radius, scatter)
      .input("Subsurface Color", &Node::subsurface_color, scatter)
      .input("Subsurface IOR", &Node::subsurface_ior, scatter)
      .input("Subsurface Anisotropy", &Node::subsurface_anisotropy, scatter)
      .input("Metallic", &Node::metallic, scatter)
      .input("Specular", &Node::specular, scatter)
      .input("Specular Tint", &Node::specular_tint, scatter)
      .input("Roughness", &Node::roughness, scatter)
      .input("Anisotropic", &Node::anisotropic, scatter)
      .input("Anisotropic Rotation", &Node::anisotropic_rotation, scatter)
      .input("Sheen", &Node::sheen, scatter)
      .input("Sheen Tint", &Node::sheen_tint, scatter)
      .input("Clearcoat", &Node::clearcoat, scatter)
      .input("Clearcoat Roughness", &Node::clearcoat_roughness, scatter)
      .input("IOR", &Node::ior, scatter)
      .input("Transmission", &Node::transmission, scatter)
      .input("Transmission Roughness", &Node::transmission_roughness, scatter)
      .input("Emission", &Node::emission, emission)
      .input("Emission Strength", &Node::emission_strength, emission)
      .input("Alpha", &Node::alpha)
      .input("Normal", &Node::normal, scatter)
      .implicit(ImplicitInput::normal)
      .input("Clearcoat Normal", &Node::clearcoat_normal, scatter)
      .implicit(ImplicitInput::normal)
      .input("Tangent", &Node::tangent, scatter)
      .implicit(ImplicitInput::tangent)
      .choice(
          "distribution", &Node::distribution,
          {{"GGX", PrincipledDistribution::ggx}, {"MULTI_GGX", PrincipledDistribution::multi_ggx}})
      .choice("subsurface_method", &Node::subsurface_method,
              {{"BURLEY", SubsurfaceMethod::christensen_burley},
               {"RANDOM_WALK_FIXED_RADIUS", SubsurfaceMethod::fixed_radius_walk},
               {"RANDOM_WALK", SubsurfaceMethod::random_walk}})
      .closure_output("BSDF")
      .closure();
}

}  // namespace tenniel
