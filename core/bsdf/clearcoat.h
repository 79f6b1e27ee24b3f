// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "bsdf/ggx.h"
#include "bsdf/microsurface.h"
#include "bsdf/specular.h"

namespace tenniel {

// Clearcoat of the Principled BSDF up to Blender 3.6 (Burley 2012, "Physically-Based Shading at
// Disney", section 5.4): GTR1 facets of `alpha`, masking of a GGX surface with alpha 0.25, index
// 1.5. The factor 0.25 * clearcoat is the caller's weight.
//
// As in Cycles the samples are reflections in GGX facets, but are divided by the density that GTR1
// facets would have. So lamps make the wide glow of GTR1, and what paths meet by chance is mirrored
// as sharply as by GGX: which is how artists know varnish and car paint. They may leave below the
// horizon, as those of MicrofacetReflection.
struct Clearcoat {
  float alpha = 0.0009f;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  bool is_delta() const { return is_specular(alpha, alpha); }
  float roughness() const { return alpha; }
  bool make_valid() {
    if (!std::isfinite(alpha)) return false;
    alpha = saturate(alpha);
    return true;
  }
  void widen(float least) { alpha = std::max(alpha, least); }
  static Spectrum albedo(Vec3 wo) { return fresnel()(wo.z); }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (is_delta() || !(wo.z > 0.0f) || !(wi.z > 0.0f)) return {};
    const Vec3 half = wo + wi;
    const float half_length = length(half);
    return eval_facet(wo, wi, half / half_length, 0.5f * half_length);
  }

  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    if (is_delta()) return SpecularReflection{fresnel()}.sample(wo, u);
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Vec3 m = ggx::sample_visible_normal(wo, alpha, alpha, u);
    const Vec3 wi = normalize(reflect(wo, m));
    const float cos_facet = dot(wo, m);
    if (!(cos_facet > 0.0f)) return std::nullopt;
    const LobeEval e = eval_facet(wo, wi, m, cos_facet);
    if (!(e.pdf > 0.0f)) return std::nullopt;
    return LobeSample{wi, e.value / e.pdf, e.pdf};
  }

 private:
  static constexpr float k_masking_alpha = 0.25f;

  static Fresnel fresnel() { return Fresnel::principled(Spectrum(0.04f), 1.5f); }

  // GTR1 (eq. 4); the ratio tends to 1 where alpha does.
  float normal_density(Vec3 m) const {
    const float excess = sqr(alpha) - 1.0f;
    const float scale = excess < 0.0f ? excess / (2.0f * std::log(alpha)) : 1.0f;
    return scale * k_inv_pi / (sqr(m.x) + sqr(m.y) + sqr(alpha * m.z));
  }

  LobeEval eval_facet(Vec3 wo, Vec3 wi, Vec3 m, float cos_facet) const {
    // G1(w) = cos / visible area, which is never 0.
    const auto area = [](Vec3 w) { return ggx::visible_area(w, k_masking_alpha, k_masking_alpha); };
    const float pdf = 0.25f * normal_density(m) / area(wo);
    return {fresnel()(cos_facet) * (pdf * std::abs(wi.z) / area(wi)), pdf};
  }
};

}  // namespace tenniel
