// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "bsdf/microsurface.h"
#include "bsdf/specular.h"

namespace tenniel {

// What light meets when it bounces about a rough surface.
struct MultiScatter {
  float alpha_x = 0.5f, alpha_y = 0.5f;
  float eta = 0.0f;        // of a dielectric, as in MicrofacetRefraction; 0: all is reflected
  Spectrum tint{1.0f};     // of every bounce after the first, whose colour is the lobe's weight
  Spectrum passing{1.0f};  // of every refraction
  Fresnel reflecting{};    // of every reflection
  uint32_t seed = 0;       // varies from sample to sample

  bool make_valid();
};

// GGX with all scattering between its facets: a random walk over heights (Heitz, Hanika, d'Eon,
// Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model"). `eval` is an
// estimate with the right mean, and `pdf` an approximation of the density: what is sampled is worth
// its weight, and both strategies agree on the same pdf for their shares.
struct MultiGgxReflection {
  MultiScatter surface;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  bool is_delta() const { return is_specular(surface.alpha_x, surface.alpha_y); }
  float roughness() const { return std::sqrt(surface.alpha_x * surface.alpha_y); }
  bool make_valid() { return surface.make_valid(); }
  void widen(float alpha);
  Spectrum albedo(Vec3 wo) const;
  LobeEval eval(Vec3 wo, Vec3 wi) const;
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const;
};

// The part of the same walk that ends beyond the surface.
struct MultiGgxTransmission {
  MultiScatter surface;

  static constexpr LobeClass lobe_class() { return LobeClass::transmission; }
  bool is_delta() const { return is_specular(surface.alpha_x, surface.alpha_y); }
  float roughness() const { return std::sqrt(surface.alpha_x * surface.alpha_y); }
  bool make_valid() { return surface.make_valid() && surface.eta > 0.0f; }
  void widen(float alpha);
  Spectrum albedo(Vec3 wo) const;
  LobeEval eval(Vec3 wo, Vec3 wi) const;
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const;
};

}  // namespace tenniel
