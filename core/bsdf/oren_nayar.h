// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/diffuse.h"

namespace tenniel {

// Rough diffuse surface: Oren & Nayar 1994 in the form of Fujii, "A tiny improvement of Oren-Nayar
// reflectance model", that Cycles has up to 4.2. `sigma` in [0, 1]; 0 is Lambert's law.
struct OrenNayar {
  float sigma = 0.0f;

  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  bool make_valid() {
    if (!std::isfinite(sigma)) return false;
    sigma = saturate(sigma);
    return true;
  }
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }

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
    const float cos_o = std::max(wo.z, 0.0f), cos_i = std::max(wi.z, 0.0f);
    float t = dot(wo, wi) - cos_o * cos_i;
    if (t > 0.0f) t = safe_divide(t, std::max(cos_o, cos_i));
    const float norm = 1.0f / (k_pi + (3.0f * k_pi - 4.0f) / 6.0f * sigma);
    return std::max(0.0f, cos_i * norm * (1.0f + sigma * t));
  }
};

}  // namespace tenniel
