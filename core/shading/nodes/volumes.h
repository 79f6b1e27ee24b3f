// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/node_type.h"

// Shaders of what fills a volume, with the meaning they have in Blender 3.4. Densities are per
// metre of the world, whatever the scale of the object.
namespace tenniel {

struct VolumeAbsorptionNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> density{1.0f};
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
};

struct VolumeScatterNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> density{1.0f}, anisotropy;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
};

// Grids of a simulation scale what the sockets say; only the exporter names any.
struct PrincipledVolumeNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.5f)}, absorption_color;
  Input<float> density{1.0f}, anisotropy;
  Input<float> emission_strength, blackbody_intensity, temperature{1000.0f};
  Input<Spectrum> emission_color{Spectrum(1.0f)}, blackbody_tint{Spectrum(1.0f)};
  AttributeSlot density_attribute, color_attribute, temperature_attribute;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
  bool varies() const;
  std::optional<GridMedium> grid_medium() const;

 private:
  Spectrum glow(const ShadingContext& context) const;
};

}  // namespace tenniel
