// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "bsdf/microsurface.h"
#include "bsdf/specular.h"

namespace tenniel {

// Transmission through a rough boundary (Walter et al. 2007, eq. 21) with separable Smith masking
// and a facet transmittance of 1: the caller's weight carries 1 - F, as in Cycles 3.4. `eta` =
// index beyond the surface / index on wo's side.
struct MicrofacetRefraction {
  Microsurface surface;
  float eta = 1.45f;

  static constexpr LobeClass lobe_class() { return LobeClass::transmission; }
  // Besides a smooth surface, one that hardly bends: its lobe is as narrow.
  bool is_delta() const {
    const float bend = 1.0f - std::min(eta, 1.0f / eta);
    return tenniel::is_specular(surface.alpha_x * bend, surface.alpha_y * bend);
  }
  float roughness() const { return surface.mean_alpha(); }
  bool make_valid() {
    if (!surface.make_valid() || !std::isfinite(eta)) return false;
    eta = std::clamp(eta, 1e-3f, 1e3f);
    return true;
  }
  void widen(float alpha) { surface.widen(alpha); }
  Spectrum albedo(Vec3 wo) const {
    return is_delta() ? SpecularRefraction{eta}.albedo(wo) : Spectrum(1.0f);
  }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (is_delta() || !(wo.z > 0.0f) || !(wi.z < 0.0f)) return {};
    // The facet that joins the two (eq. 16), turned to wo's side.
    Vec3 half = wo + eta * wi;
    if (half.z < 0.0f) half = -half;
    const float half2 = length_squared(half);
    if (!(half2 > 0.0f)) return {};
    const Vec3 m = half / std::sqrt(half2);
    const float cos_o = dot(wo, m), cos_i = dot(wi, m);
    if (!(cos_o > 0.0f) || !(cos_i < 0.0f)) return {};
    const float area = surface.visible_area(wo);
    const float pdf = facet_pdf(m, cos_o, area) * jacobian(cos_i, half2);
    const float masking = surface.masking_of_visible(wo, area, wi);
    return {Spectrum(pdf * masking), pdf};
  }

  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    if (is_delta()) return SpecularRefraction{eta}.sample(wo, u);
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Vec3 m = surface.sample_visible_normal(wo, u);
    const float cos_o = dot(wo, m);
    const std::optional<Vec3> wi = refract(wo, m, eta);
    if (!wi || !(cos_o > 0.0f) || !(wi->z < 0.0f)) return std::nullopt;
    const float cos_i = dot(*wi, m);
    const float area = surface.visible_area(wo);
    const float pdf = facet_pdf(m, cos_o, area) * jacobian(cos_i, sqr(cos_o + eta * cos_i));
    if (!(pdf > 0.0f) || !std::isfinite(pdf)) return std::nullopt;
    const float masking = surface.masking_of_visible(wo, area, *wi);
    return LobeSample{*wi, Spectrum(masking), pdf};
  }

 private:
  float facet_pdf(Vec3 m, float cos_o, float area) const {
    return surface.normal_density(m) * cos_o / area;
  }
  // Solid angle of facets per solid angle of wi (eq. 17).
  float jacobian(float cos_i, float half2) const { return sqr(eta) * std::abs(cos_i) / half2; }
};

}  // namespace tenniel
