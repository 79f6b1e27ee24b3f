// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "bsdf/microsurface.h"
#include "bsdf/specular.h"

namespace tenniel {

// Reflection off a rough boundary (Walter et al. 2007, eq. 20) with separable Smith masking
// G1(wo) G1(wi), as Cycles 3.4. A mirror where the surface is too smooth.
//
// Also as in Cycles, samples may leave below the horizon of the lobe's normal, where `eval` is
// black. Where that normal is bent away from the true surface's they count, and look as in Cycles.
struct MicrofacetReflection {
  Microsurface surface;
  Fresnel fresnel;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  bool is_delta() const { return surface.is_specular(); }
  float roughness() const { return surface.mean_alpha(); }
  bool make_valid() { return surface.make_valid() && fresnel.is_finite(); }
  void widen(float alpha) { surface.widen(alpha); }
  Spectrum albedo(Vec3 wo) const { return fresnel(wo.z); }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (is_delta() || !(wo.z > 0.0f) || !(wi.z > 0.0f)) return {};
    const Vec3 m = normalize(wo + wi);
    const float area = surface.visible_area(wo);
    const float pdf = surface.normal_density(m) / (4.0f * area);
    const float masking = surface.masking_of_visible(wo, area, wi);
    return {fresnel(dot(wo, m)) * (pdf * masking), pdf};
  }

  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    if (is_delta()) return SpecularReflection{fresnel}.sample(wo, u);
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Vec3 m = surface.sample_visible_normal(wo, u);
    const Vec3 wi = normalize(reflect(wo, m));
    const float area = surface.visible_area(wo);
    const float pdf = surface.normal_density(m) / (4.0f * area);
    if (!(pdf > 0.0f)) return std::nullopt;
    const float masking = surface.masking_of_visible(wo, area, wi);
    return LobeSample{wi, fresnel(dot(wo, m)) * masking, pdf};
  }
};

}  // namespace tenniel
