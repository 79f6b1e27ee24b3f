// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "bsdf/diffuse.h"
#include "math/numeric.h"

namespace tenniel {

// Upright fibres (Ashikhmin, Premoze, Shirley 2000, "A Microfacet-based BRDF Generator", section
// 5.2: inverted Gaussian of slope `sigma`, V-groove masking), as Blender has it up to 3.6.
struct Velvet {
  float sigma = 1.0f;

  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  bool make_valid() {
    if (!std::isfinite(sigma)) return false;
    sigma = std::max(saturate(sigma), 0.01f);
    return true;
  }
  static void widen(float) {}
  // Fit to the integral over wi; within 0.08 everywhere.
  Spectrum albedo(Vec3 wo) const {
    const float x = wo.z / sigma;
    return Spectrum(std::exp(-x * (0.85f + 0.33f * x)));
  }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (!(wi.z > 0.0f) || !(wo.z > 0.0f)) return {};
    return {Spectrum(value(wo, wi)), uniform_hemisphere_pdf()};
  }
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    const Vec3 wi = warp_uniform_hemisphere(u);
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return std::nullopt;
    const float pdf = uniform_hemisphere_pdf();
    return LobeSample{wi, Spectrum(value(wo, wi) / pdf), pdf};
  }

 private:
  float value(Vec3 wo, Vec3 wi) const {
    const Vec3 half = normalize(wo + wi);
    const float cos_half = half.z, cos_wo_half = dot(wo, half);
    const float sin2_half = 1.0f - sqr(cos_half);
    // No fibre lies flat, and none is seen from nearly opposite directions.
    if (!(cos_half < 1.0f - 1e-5f) || !(cos_wo_half > 1e-5f)) return 0.0f;
    const float inverse_variance = 1.0f / sqr(sigma);
    const float density = std::exp(-sqr(cos_half) / sin2_half * inverse_variance) *
                          inverse_variance / (k_pi * sqr(sin2_half));
    const float groove = 2.0f * std::max(cos_half / cos_wo_half, 1e-5f);
    const float visible = std::min({1.0f, groove * wo.z, groove * wi.z});
    return 0.25f * density * visible / wo.z;
  }
};

}  // namespace tenniel
