// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "bsdf/beckmann.h"
#include "bsdf/ggx.h"

namespace tenniel {

// True where a microsurface is too smooth to be told from a mirror (Cycles' limit).
constexpr bool is_specular(float alpha_x, float alpha_y) {
  return alpha_x * alpha_y <= 1e-7f;
}

enum class MicrofacetDistribution : uint8_t { ggx, beckmann };

// The rough boundary that microfacet lobes share. alpha = roughness^2, in [0, 1]; x is the tangent.
struct Microsurface {
  MicrofacetDistribution distribution = MicrofacetDistribution::ggx;
  float alpha_x = 0.5f, alpha_y = 0.5f;

  bool is_specular() const { return tenniel::is_specular(alpha_x, alpha_y); }
  float mean_alpha() const { return std::sqrt(alpha_x * alpha_y); }
  void widen(float alpha) {
    alpha_x = std::max(alpha_x, alpha);
    alpha_y = std::max(alpha_y, alpha);
  }
  // Forces the parameters into range; false if they are not numbers.
  bool make_valid() {
    if (!std::isfinite(alpha_x) || !std::isfinite(alpha_y)) return false;
    alpha_x = saturate(alpha_x);
    alpha_y = saturate(alpha_y);
    return true;
  }

  // The rest must not be called for a specular surface.
  float normal_density(Vec3 m) const {
    return is_ggx() ? ggx::normal_density(m, alpha_x, alpha_y)
                    : beckmann::normal_density(m, alpha_x, alpha_y);
  }
  float visible_area(Vec3 w) const {
    return is_ggx() ? ggx::visible_area(w, alpha_x, alpha_y)
                    : beckmann::visible_area(w, alpha_x, alpha_y);
  }
  // G1(w) = cos / visible area (Heitz 2014, eq. 14); of Beckmann facets Walter's fit, as Cycles.
  float masking(Vec3 w) const {
    return is_ggx() ? std::abs(w.z) / visible_area(w) : beckmann::masking(w, alpha_x, alpha_y);
  }
  // What G1(wo) G1(wi) leaves of light off a facet drawn by `sample_visible_normal`: value / pdf.
  float masking_of_visible(Vec3 wo, float area_o, Vec3 wi) const {
    if (is_ggx()) return masking(wi);  // G1(wo) is what the facets were drawn by
    return masking(wo) * (area_o / wo.z) * masking(wi);
  }
  Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const {
    return is_ggx() ? ggx::sample_visible_normal(wo, alpha_x, alpha_y, u)
                    : beckmann::sample_visible_normal(wo, alpha_x, alpha_y, u);
  }

 private:
  bool is_ggx() const { return distribution == MicrofacetDistribution::ggx; }
};

}  // namespace tenniel
