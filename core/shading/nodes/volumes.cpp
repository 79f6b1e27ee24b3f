// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/volumes.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/blackbody.h"
#include "shading/nodes/register.h"

namespace tenniel {
namespace {

constexpr float k_cutoff = 1e-5f;

bool may_be_dense(const Input<float>& density) {
  return density.linked() || density.value > 0.0f;
}

float usable_density(const ShadingContext& context, const Input<float>& density) {
  return std::max(context.get(density), 0.0f);
}

float rest(float x) {
  return std::max(1.0f - x, 0.0f);
}
// What white is more than `color`.
Spectrum complement(Spectrum color) {
  return {rest(color.r), rest(color.g), rest(color.b)};
}
Spectrum root(Spectrum color) {
  return {safe_sqrt(color.r), safe_sqrt(color.g), safe_sqrt(color.b)};
}

// What a simulation would store in each voxel: a mesh has none of it.
struct VolumeInfoNode {
  Output<Spectrum> color;
  Output<float> density, flame, temperature;
  void eval(ShadingContext& context) const {
    context.set(color, Spectrum());
    context.set(density, 0.0f);
    context.set(flame, 0.0f);
    context.set(temperature, 0.0f);
  }
};

}  // namespace

void VolumeAbsorptionNode::eval(ShadingContext& context) const {
  const float d = usable_density(context, density) * context.get(weight);
  context.medium.add_absorption(complement(context.get(color)) * d);
}

uint8_t VolumeAbsorptionNode::closure_parts() const {
  return may_be_dense(density) ? k_query_volume : 0;
}

void VolumeScatterNode::eval(ShadingContext& context) const {
  const float d = usable_density(context, density) * context.get(weight);
  context.medium.add_scattering(context.get(color) * d, context.get(anisotropy));
}

uint8_t VolumeScatterNode::closure_parts() const {
  return may_be_dense(density) ? k_query_volume : 0;
}

void PrincipledVolumeNode::eval(ShadingContext& context) const {
  const float d = usable_density(context, density) * context.get(weight);
  if (d > k_cutoff) {
    const Spectrum scattered = context.get(color);
    const Spectrum absorbed =
        complement(scattered) * complement(root(context.get(absorption_color)));
    context.medium.add_scattering(scattered * d, context.get(anisotropy));
    context.medium.add_absorption(absorbed * d);
  }
  context.add_emission(glow(context));
}

Spectrum PrincipledVolumeNode::glow(const ShadingContext& context) const {
  Spectrum sum;
  const float strength = context.get(emission_strength);
  if (strength > k_cutoff) sum += context.get(emission_color) * strength;
  const float blackbody = context.get(blackbody_intensity);
  if (!(blackbody > k_cutoff)) return sum;
  // Stefan and Boltzmann's law, in a unit that suits flames.
  constexpr float k_sigma = 5.670373e-8f * 1e-6f * k_inv_pi;
  const float kelvin = std::max(context.get(temperature), 0.0f);
  const float intensity = k_sigma * lerp(1.0f, sqr(sqr(kelvin)), blackbody);
  if (intensity > k_cutoff)
    sum += blackbody_color(kelvin) * context.get(blackbody_tint) * intensity;
  return sum;
}

uint8_t PrincipledVolumeNode::closure_parts() const {
  const auto may_be_positive = [](const Input<float>& x) { return x.linked() || x.value > 0.0f; };
  const bool glows = may_be_positive(emission_strength) || may_be_positive(blackbody_intensity);
  return static_cast<uint8_t>((may_be_dense(density) ? k_query_volume : 0) |
                              (glows ? k_query_emission : 0));
}

void register_volume_nodes(NodeRegistry& registry) {
  registry.add<VolumeAbsorptionNode>("ShaderNodeVolumeAbsorption")
      .input("Color", &VolumeAbsorptionNode::color)
      .input("Density", &VolumeAbsorptionNode::density)
      .closure_output("Volume")
      .closure();
  registry.add<VolumeScatterNode>("ShaderNodeVolumeScatter")
      .input("Color", &VolumeScatterNode::color)
      .input("Density", &VolumeScatterNode::density)
      .input("Anisotropy", &VolumeScatterNode::anisotropy)
      .closure_output("Volume")
      .closure();
  registry.add<PrincipledVolumeNode>("ShaderNodeVolumePrincipled")
      .input("Color", &PrincipledVolumeNode::color)
      .input("Density", &PrincipledVolumeNode::density)
      .input("Anisotropy", &PrincipledVolumeNode::anisotropy)
      .input("Absorption Color", &PrincipledVolumeNode::absorption_color)
      .input("Emission Strength", &PrincipledVolumeNode::emission_strength)
      .input("Emission Color", &PrincipledVolumeNode::emission_color)
      .input("Blackbody Intensity", &PrincipledVolumeNode::blackbody_intensity)
      .input("Blackbody Tint", &PrincipledVolumeNode::blackbody_tint)
      .input("Temperature", &PrincipledVolumeNode::temperature)
      .closure_output("Volume")
      .closure();
  registry.add<VolumeInfoNode>("ShaderNodeVolumeInfo")
      .output("Color", &VolumeInfoNode::color)
      .output("Density", &VolumeInfoNode::density)
      .output("Flame", &VolumeInfoNode::flame)
      .output("Temperature", &VolumeInfoNode::temperature);
}

}  // namespace tenniel
