// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/node_type.h"

namespace tenniel {

enum class PrincipledDistribution : uint8_t { ggx, multi_ggx };

// Principled BSDF of Blender 2.8 to 3.6 (Burley 2012 and 2015): lobes are added, not layered.
struct PrincipledV1Node {
  Input<float> weight;
  Input<Spectrum> base_color{Spectrum(0.8f)};
  Input<float> subsurface{0.0f};
  Input<Vec3> subsurface_radius{{1.0f, 0.2f, 0.1f}};
  Input<Spectrum> subsurface_color{Spectrum(0.8f)};
  Input<float> subsurface_ior{1.4f}, subsurface_anisotropy{0.0f};
  Input<float> metallic{0.0f}, specular{0.5f}, specular_tint{0.0f}, roughness{0.5f};
  Input<float> anisotropic{0.0f}, anisotropic_rotation{0.0f};
  Input<float> sheen{0.0f}, sheen_tint{0.5f};
  Input<float> clearcoat{0.0f}, clearcoat_roughness{0.03f};
  Input<float> ior{1.45f}, transmission{0.0f}, transmission_roughness{0.0f};
  Input<Spectrum> emission;
  Input<float> emission_strength{1.0f}, alpha{1.0f};
  Input<Vec3> normal, clearcoat_normal, tangent;
  PrincipledDistribution distribution = PrincipledDistribution::ggx;
  SubsurfaceMethod subsurface_method = SubsurfaceMethod::random_walk;

  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
  bool has_subsurface() const { return subsurface.linked() || subsurface.value > 0.0f; }

 private:
  void scatter(ShadingContext& context, float opacity) const;
  Vec3 turned_tangent(const ShadingContext& context, Vec3 n) const;
};

}  // namespace tenniel
