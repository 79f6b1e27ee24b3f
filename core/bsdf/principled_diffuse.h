// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/diffuse.h"
#include "bsdf/fresnel.h"

namespace tenniel {

// Terms of PrincipledDiffuse. Where light goes below the surface they part: what it keeps of itself
// there is retro-reflection, what comes out elsewhere knows nothing of wo.
enum class PrincipledDiffuseTerms : uint8_t { all, lambert, lambert_exit, retro_reflection };

// Diffuse part of the Principled BSDF up to Blender 3.6: Burley 2015, "Extending the Disney BRDF to
// a BSDF with Integrated Subsurface Scattering", eq. 4: Lambert with Fresnel on the way in and out,
// plus retro-reflection that grows with `roughness_parameter` in [0, 1].
struct PrincipledDiffuse {
  float roughness_parameter = 0.5f;
  PrincipledDiffuseTerms terms = PrincipledDiffuseTerms::all;

  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  bool make_valid() {
    if (!std::isfinite(roughness_parameter)) return false;
    roughness_parameter = saturate(roughness_parameter);
    return true;
  }
  static void widen(float) {}
  Spectrum albedo(Vec3 wo) const {
    if (terms != PrincipledDiffuseTerms::retro_reflection) return Spectrum(1.0f);
    // Without the product of both Fresnel terms: 1/21 is the mean of Schlick's.
    const float of_wo = schlick_weight(wo.z) * (1.0f + wo.z * (2.0f / 3.0f));
    return Spectrum(roughness_parameter * (of_wo + 1.0f / 21.0f));
  }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (!(wi.z > 0.0f)) return {};
    return {Spectrum(value(wo, wi)), cosine_hemisphere_pdf(wi.z)};
  }
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    const Vec3 wi = warp_cosine_hemisphere(u);
    return cosine_sample(wi, Spectrum(value(wo, wi)));
  }

 private:
  float value(Vec3 wo, Vec3 wi) const {
    const float fresnel_i = schlick_weight(wi.z), fresnel_o = schlick_weight(wo.z);
    // 2 r cos^2(theta_d), the half angle between wo and wi: r (cos(2 theta_d) + 1).
    const float retro = roughness_parameter * (dot(wo, wi) + 1.0f);
    float factor = 0.0f;
    if (terms == PrincipledDiffuseTerms::all || terms == PrincipledDiffuseTerms::lambert)
      factor += (1.0f - 0.5f * fresnel_i) * (1.0f - 0.5f * fresnel_o);
    if (terms == PrincipledDiffuseTerms::lambert_exit) factor += 1.0f - 0.5f * fresnel_i;
    if (terms == PrincipledDiffuseTerms::all || terms == PrincipledDiffuseTerms::retro_reflection)
      factor += retro * (fresnel_i + fresnel_o + fresnel_i * fresnel_o * (retro - 1.0f));
    return k_inv_pi * std::max(wi.z, 0.0f) * factor;
  }
};

}  // namespace tenniel
