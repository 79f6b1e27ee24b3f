// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"

namespace tenniel {

// A perfect mirror.
struct SpecularReflection {
  Fresnel fresnel;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  static constexpr bool is_delta() { return true; }
  static constexpr float roughness() { return 0.0f; }
  bool make_valid() const { return fresnel.is_finite(); }
  static void widen(float) {}
  Spectrum albedo(Vec3 wo) const { return fresnel(wo.z); }
  static LobeEval eval(Vec3, Vec3) { return {}; }
  std::optional<LobeSample> sample(Vec3 wo, Vec2) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    return LobeSample{{-wo.x, -wo.y, wo.z}, fresnel(wo.z)};
  }
};

// A perfectly smooth boundary that transmits all it can; the caller's weight carries 1 - F. `eta`
// as in MicrofacetRefraction.
struct SpecularRefraction {
  float eta = 1.45f;

  static constexpr LobeClass lobe_class() { return LobeClass::transmission; }
  static constexpr bool is_delta() { return true; }
  static constexpr float roughness() { return 0.0f; }
  bool make_valid() {
    if (!std::isfinite(eta)) return false;
    eta = std::clamp(eta, 1e-3f, 1e3f);
    return true;
  }
  static void widen(float) {}
  // 0 at total internal reflection.
  Spectrum albedo(Vec3 wo) const { return Spectrum(sample(wo, {}) ? 1.0f : 0.0f); }
  static LobeEval eval(Vec3, Vec3) { return {}; }
  std::optional<LobeSample> sample(Vec3 wo, Vec2) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const std::optional<Vec3> wi = refract(wo, {0.0f, 0.0f, 1.0f}, eta);
    if (!wi) return std::nullopt;
    return LobeSample{*wi, Spectrum(1.0f)};
  }
};

}  // namespace tenniel
