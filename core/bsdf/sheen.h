// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/diffuse.h"
#include "bsdf/fresnel.h"

namespace tenniel {

// Sheen of the Principled BSDF up to Blender 3.6 (Burley 2012, "Physically-Based Shading at
// Disney", section 5.3): Schlick's weight of the half angle, without 1 / pi.
struct PrincipledSheen {
  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  static constexpr bool make_valid() { return true; }
  static void widen(float) {}
  // Fit to the integral over wi; within 7 % where that is above 0.01.
  static Spectrum albedo(Vec3 wo) {
    const float t = saturate(1.0f - wo.z);
    return Spectrum(0.0885f * sqr(t) * std::sqrt(t) + 0.0003f);
  }

  static LobeEval eval(Vec3 wo, Vec3 wi) {
    if (!(wi.z > 0.0f) || !(wo.z > 0.0f)) return {};
    return {Spectrum(value(wo, wi)), cosine_hemisphere_pdf(wi.z)};
  }
  static std::optional<LobeSample> sample(Vec3 wo, Vec2 u) {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Vec3 wi = warp_cosine_hemisphere(u);
    return cosine_sample(wi, Spectrum(value(wo, wi)));
  }

 private:
  static float value(Vec3 wo, Vec3 wi) {
    const float cos_half = safe_sqrt(0.5f * (1.0f + dot(wo, wi)));
    return schlick_weight(cos_half) * wi.z;
  }
};

}  // namespace tenniel
