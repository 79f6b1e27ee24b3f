// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/closures.h"

#include <algorithm>

#include "bsdf/fresnel.h"
#include "math/hash.h"
#include "math/numeric.h"
#include "shading/nodes/register.h"
#include "shading/surface_tangent.h"

namespace tenniel {
namespace {

// What Cycles leaves of refraction where the Fresnel term says that nothing passes.
constexpr float k_min_transmittance = 1e-4f;

bool may_be_seen(const Input<Spectrum>& color, const Input<float>& strength) {
  return (color.linked() || !is_black(color.value)) &&
         (strength.linked() || strength.value != 0.0f);
}

// A sentence where constants alone make the emission unusable.
const char* emission_note(const Input<Spectrum>& color, const Input<float>& strength) {
  const Spectrum constant =
      (color.linked() ? Spectrum(1.0f) : color.value) * (strength.linked() ? 1.0f : strength.value);
  return is_usable_emission(constant) ? nullptr
                                      : "its strength is not a usable number; it emits nothing";
}

Microsurface microsurface(GlossyDistribution distribution, float alpha_x, float alpha_y) {
  return {distribution == GlossyDistribution::beckmann ? MicrofacetDistribution::beckmann
                                                       : MicrofacetDistribution::ggx,
          alpha_x, alpha_y};
}

MultiScatter multi_scatter(const ShadingContext& context, Spectrum tint, float alpha_x,
                           float alpha_y) {
  MultiScatter scatter{alpha_x, alpha_y};
  scatter.tint = tint;
  scatter.seed = walk_seed(context.surface);
  return scatter;
}

Lobe rough_reflection(GlossyDistribution distribution, float alpha_x, float alpha_y,
                      const Fresnel& fresnel = Fresnel::none()) {
  if (distribution == GlossyDistribution::ashikhmin_shirley)
    return AshikhminShirley{alpha_x, alpha_y};
  return MicrofacetReflection{microsurface(distribution, alpha_x, alpha_y), fresnel};
}

Lobe reflection_lobe(GlossyDistribution distribution, float roughness,
                     const Fresnel& fresnel = Fresnel::none()) {
  if (distribution == GlossyDistribution::sharp) return SpecularReflection{fresnel};
  const float alpha = sqr(saturate(roughness));
  return rough_reflection(distribution, alpha, alpha, fresnel);
}

Spectrum non_negative(Vec3 v) {
  return {std::max(v.x, 0.0f), std::max(v.y, 0.0f), std::max(v.z, 0.0f)};
}

Lobe refraction_lobe(GlossyDistribution distribution, float roughness, float eta) {
  if (distribution == GlossyDistribution::sharp) return SpecularRefraction{eta};
  const float alpha = sqr(saturate(roughness));
  return MicrofacetRefraction{microsurface(distribution, alpha, alpha), eta};
}

}  // namespace

uint32_t walk_seed(const SurfaceInteraction& surface) {
  const Vec3 p = surface.position, d = surface.wo;
  const uint32_t place = hash_uint(float_bits(p.x), float_bits(p.y), float_bits(p.z));
  return hash_uint(place, float_bits(d.x), float_bits(d.y), float_bits(d.z));
}

float relative_ior(const SurfaceInteraction& surface, float ior) {
  const float eta = std::max(ior, 1e-5f);
  return surface.is_back_facing ? 1.0f / eta : eta;
}

void DiffuseNode::eval(ShadingContext& context) const {
  const float sigma = context.get(roughness);
  const Spectrum tint = context.get(color) * context.get(weight);
  if (sigma > 0.0f) return context.bsdf.add(OrenNayar{sigma}, tint, context.normal(normal));
  context.bsdf.add(Diffuse{}, tint, context.normal(normal));
}

void GlossyNode::eval(ShadingContext& context) const {
  if (distribution == GlossyDistribution::multi_ggx) {
    const float alpha = sqr(saturate(context.get(roughness)));
    return context.bsdf.add(
        MultiGgxReflection{multi_scatter(context, context.get(color), alpha, alpha)},
        context.get(color) * context.get(weight), context.normal(normal));
  }
  context.bsdf.add(reflection_lobe(distribution, context.get(roughness)),
                   context.get(color) * context.get(weight), context.normal(normal));
}

void ConductorNode::eval(ShadingContext& context) const {
  const Fresnel fresnel =
      Fresnel::conductor(non_negative(context.get(eta)), non_negative(context.get(k)));
  context.bsdf.add(reflection_lobe(distribution, context.get(roughness), fresnel),
                   Spectrum(context.get(weight)), context.normal(normal));
}

void AnisotropicNode::eval(ShadingContext& context) const {
  const Vec3 n = context.normal(normal);
  const float alpha = sqr(saturate(context.get(roughness)));
  const float a = std::clamp(context.get(anisotropy), -0.99f, 0.99f);
  const float alpha_x = a < 0.0f ? alpha / (1.0f + a) : alpha * (1.0f - a);
  const float alpha_y = a < 0.0f ? alpha * (1.0f + a) : alpha / (1.0f - a);
  const Vec3 along = tangent.linked() ? context.get(tangent) : surface_tangent(context.surface, n);
  const Vec3 turned = rotate_about(along, n, k_two_pi * context.get(rotation));
  const Lobe lobe =
      distribution == GlossyDistribution::multi_ggx
          ? Lobe(MultiGgxReflection{multi_scatter(context, context.get(color), alpha_x, alpha_y)})
          : rough_reflection(distribution, alpha_x, alpha_y);
  context.bsdf.add(lobe, context.get(color) * context.get(weight), n, turned);
}

void GlassNode::eval(ShadingContext& context) const {
  const Vec3 n = context.normal(normal);
  const float eta = relative_ior(context.surface, context.get(ior));
  const float reflectance = fresnel_dielectric(dot(n, context.surface.wo), eta);
  const float rough = context.get(roughness);
  const Spectrum tint = context.get(color) * context.get(weight);
  if (distribution == GlossyDistribution::multi_ggx) {
    const float alpha = sqr(saturate(rough));
    MultiScatter scatter = multi_scatter(context, context.get(color), alpha, alpha);
    scatter.eta = eta;
    context.bsdf.add(MultiGgxReflection{scatter}, tint, n);
    return context.bsdf.add(MultiGgxTransmission{scatter}, tint, n);
  }
  context.bsdf.add(reflection_lobe(distribution, rough), tint * reflectance, n);
  context.bsdf.add(refraction_lobe(distribution, rough, eta),
                   tint * std::max(1.0f - reflectance, k_min_transmittance), n);
}

void RefractionNode::eval(ShadingContext& context) const {
  const float eta = relative_ior(context.surface, context.get(ior));
  context.bsdf.add(refraction_lobe(distribution, context.get(roughness), eta),
                   context.get(color) * context.get(weight), context.normal(normal));
}

void TranslucentNode::eval(ShadingContext& context) const {
  context.bsdf.add(Translucent{}, context.get(color) * context.get(weight), context.normal(normal));
}

void VelvetNode::eval(ShadingContext& context) const {
  context.bsdf.add(Velvet{context.get(sigma)}, context.get(color) * context.get(weight),
                   context.normal(normal));
}

void TransparentNode::eval(ShadingContext& context) const {
  context.transparency += context.get(color) * context.get(weight);
}

uint8_t TransparentNode::closure_parts() const {
  return color.linked() || !is_black(color.value) ? k_query_transparency : 0;
}

void EmissionNode::eval(ShadingContext& context) const {
  context.add_emission(context.get(color) * (context.get(strength) * context.get(weight)));
}

uint8_t EmissionNode::closure_parts() const {
  return may_be_seen(color, strength) ? k_query_emission : 0;
}

const char* EmissionNode::note() const {
  return emission_note(color, strength);
}

void BackgroundNode::eval(ShadingContext& context) const {
  context.add_emission(context.get(color) * (context.get(strength) * context.get(weight)));
}

uint8_t BackgroundNode::closure_parts() const {
  return may_be_seen(color, strength) ? k_query_emission : 0;
}

const char* BackgroundNode::note() const {
  return emission_note(color, strength);
}

void HoldoutNode::eval(ShadingContext& context) const {
  context.holdout += context.get(weight);
}

namespace {

constexpr auto k_ggx = GlossyDistribution::ggx;
constexpr auto k_ashikhmin = GlossyDistribution::ashikhmin_shirley;
constexpr auto k_multi_ggx = GlossyDistribution::multi_ggx;
constexpr auto k_beckmann = GlossyDistribution::beckmann;
constexpr auto k_sharp = GlossyDistribution::sharp;

void register_reflecting(NodeRegistry& registry) {
  registry.add<DiffuseNode>("ShaderNodeBsdfDiffuse")
      .input("Color", &DiffuseNode::color)
      .input("Roughness", &DiffuseNode::roughness)
      .input("Normal", &DiffuseNode::normal)
      .implicit(ImplicitInput::normal)
      .closure_output("BSDF")
      .closure();
  registry.add<GlossyNode>("ShaderNodeBsdfGlossy")
      .input("Color", &GlossyNode::color)
      .input("Roughness", &GlossyNode::roughness)
      .input("Normal", &GlossyNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("distribution", &GlossyNode::distribution,
              {{"SHARP", k_sharp},
               {"BECKMANN", k_beckmann},
               {"GGX", k_ggx},
               {"ASHIKHMIN_SHIRLEY", k_ashikhmin},
               {"MULTI_GGX", k_multi_ggx}})
      .closure_output("BSDF")
      .closure();
  registry.add<ConductorNode>("TennielConductor")
      .input("Eta", &ConductorNode::eta)
      .input("K", &ConductorNode::k)
      .input("Roughness", &ConductorNode::roughness)
      .input("Normal", &ConductorNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("distribution", &ConductorNode::distribution,
              {{"SHARP", k_sharp}, {"BECKMANN", k_beckmann}, {"GGX", k_ggx}})
      .closure_output("BSDF")
      .closure();
  registry.add<AnisotropicNode>("ShaderNodeBsdfAnisotropic")
      .input("Color", &AnisotropicNode::color)
      .input("Roughness", &AnisotropicNode::roughness)
      .input("Anisotropy", &AnisotropicNode::anisotropy)
      .input("Rotation", &AnisotropicNode::rotation)
      .input("Normal", &AnisotropicNode::normal)
      .implicit(ImplicitInput::normal)
      .input("Tangent", &AnisotropicNode::tangent)
      .implicit(ImplicitInput::tangent)
      .choice("distribution", &AnisotropicNode::distribution,
              {{"BECKMANN", k_beckmann},
               {"GGX", k_ggx},
               {"MULTI_GGX", k_multi_ggx},
               {"ASHIKHMIN_SHIRLEY", k_ashikhmin}})
      .closure_output("BSDF")
      .closure();
  registry.add<VelvetNode>("ShaderNodeBsdfVelvet")
      .input("Color", &VelvetNode::color)
      .input("Sigma", &VelvetNode::sigma)
      .input("Normal", &VelvetNode::normal)
      .implicit(ImplicitInput::normal)
      .closure_output("BSDF")
      .closure();
}

void register_transmitting(NodeRegistry& registry) {
  registry.add<GlassNode>("ShaderNodeBsdfGlass")
      .input("Color", &GlassNode::color)
      .input("Roughness", &GlassNode::roughness)
      .input("IOR", &GlassNode::ior)
      .input("Normal", &GlassNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("distribution", &GlassNode::distribution,
              {{"SHARP", k_sharp},
               {"BECKMANN", k_beckmann},
               {"GGX", k_ggx},
               {"MULTI_GGX", k_multi_ggx}})
      .closure_output("BSDF")
      .closure();
  registry.add<RefractionNode>("ShaderNodeBsdfRefraction")
      .input("Color", &RefractionNode::color)
      .input("Roughness", &RefractionNode::roughness)
      .input("IOR", &RefractionNode::ior)
      .input("Normal", &RefractionNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("distribution", &RefractionNode::distribution,
              {{"SHARP", k_sharp}, {"BECKMANN", k_beckmann}, {"GGX", k_ggx}})
      .closure_output("BSDF")
      .closure();
  registry.add<TranslucentNode>("ShaderNodeBsdfTranslucent")
      .input("Color", &TranslucentNode::color)
      .input("Normal", &TranslucentNode::normal)
      .implicit(ImplicitInput::normal)
      .closure_output("BSDF")
      .closure();
  registry.add<TransparentNode>("ShaderNodeBsdfTransparent")
      .input("Color", &TransparentNode::color)
      .closure_output("BSDF")
      .closure();
}

}  // namespace

void register_closure_nodes(NodeRegistry& registry) {
  register_reflecting(registry);
  register_transmitting(registry);
  registry.add<EmissionNode>("ShaderNodeEmission")
      .input("Color", &EmissionNode::color)
      .input("Strength", &EmissionNode::strength)
      .closure_output("Emission")
      .closure();
  registry.add<BackgroundNode>("ShaderNodeBackground")
      .input("Color", &BackgroundNode::color)
      .input("Strength", &BackgroundNode::strength)
      .closure_output("Background")
      .closure();
  registry.add<HoldoutNode>("ShaderNodeHoldout").closure_output("Holdout").closure();
}

}  // namespace tenniel
