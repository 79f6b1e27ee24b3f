// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "math/numeric.h"
#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// (1 - cos)^5 (Schlick 1994, eq. 15).
inline float schlick_weight(float cos_theta) {
  return pow5(saturate(1.0f - cos_theta));
}

// Unpolarised reflectance of a dielectric boundary; `eta` = index beyond it / index on wo's side
// (Cook & Torrance 1982; Walter et al. 2007, eq. 22). 1 at total internal reflection.
inline float fresnel_dielectric(float cos_theta, float eta) {
  const float c = std::abs(cos_theta);
  const float g2 = sqr(eta) - 1.0f + sqr(c);
  if (!(g2 > 0.0f)) return 1.0f;
  const float g = std::sqrt(g2);
  const float a = (g - c) / (g + c);
  const float b = ((g + c) * c - 1.0f) / ((g - c) * c + 1.0f);
  return 0.5f * sqr(a) * (1.0f + sqr(b));
}

// Unpolarised reflectance of a boundary with complex index eta + i k, relative to wo's side: the
// exact form (Pharr, Jakob, Humphreys 2016, section 8.2.1).
inline float fresnel_conductor(float cos_theta, float eta, float k) {
  const float cos2 = saturate(sqr(cos_theta)), sin2 = 1.0f - cos2;
  const float eta2 = sqr(eta), k2 = sqr(k);
  const float t0 = eta2 - k2 - sin2;
  const float a2_plus_b2 = std::sqrt(sqr(t0) + 4.0f * eta2 * k2);
  const float a = safe_sqrt(0.5f * (a2_plus_b2 + t0));
  const float s_sum = a2_plus_b2 + cos2, s_product = 2.0f * std::sqrt(cos2) * a;
  const float p_sum = cos2 * a2_plus_b2 + sqr(sin2), p_product = s_product * sin2;
  if (!(s_sum + s_product > 0.0f) || !(p_sum + p_product > 0.0f)) return 1.0f;
  const float perpendicular = (s_sum - s_product) / (s_sum + s_product);
  const float parallel = perpendicular * (p_sum - p_product) / (p_sum + p_product);
  return saturate(0.5f * (perpendicular + parallel));
}

// Direction beyond the boundary with normal `m` on wo's side (Walter et al. 2007, eq. 40); empty at
// total internal reflection.
inline std::optional<Vec3> refract(Vec3 wo, Vec3 m, float eta) {
  const float cos_o = dot(wo, m);
  const float inv_eta = 1.0f / eta;
  const float cos2_t = 1.0f - sqr(inv_eta) * (1.0f - sqr(cos_o));
  if (!(cos2_t > 0.0f)) return std::nullopt;
  return normalize((cos_o * inv_eta - std::sqrt(cos2_t)) * m - inv_eta * wo);
}

// Reflectance of a facet, by the angle at which light meets it.
class Fresnel {
 public:
  Fresnel() = default;
  // 1 at every angle.
  static Fresnel none() { return {}; }
  // Principled BSDF up to Blender 3.6: from `cspec0` facing to white at grazing, along the curve of
  // a dielectric of index `ior`.
  static Fresnel principled(Spectrum cspec0, float ior) {
    const float f0 = fresnel_dielectric(1.0f, ior);
    // A boundary that reflects all (or nothing) at normal incidence has no curve to follow.
    const float scale = f0 < 0.999f ? 1.0f / (1.0f - f0) : 0.0f;
    return {Kind::principled, cspec0, Spectrum(ior, f0, scale)};
  }
  // Complex index eta + i k of each channel, relative to the outside.
  static Fresnel conductor(Spectrum eta, Spectrum k) { return {Kind::conductor, eta, k}; }

  Spectrum operator()(float cos_theta) const {
    if (kind_ == Kind::none) return Spectrum(1.0f);
    if (kind_ == Kind::principled) {
      const auto [ior, f0, scale] = b_;
      return lerp(a_, Spectrum(1.0f), saturate((fresnel_dielectric(cos_theta, ior) - f0) * scale));
    }
    return {fresnel_conductor(cos_theta, a_.r, b_.r), fresnel_conductor(cos_theta, a_.g, b_.g),
            fresnel_conductor(cos_theta, a_.b, b_.b)};
  }

  bool is_finite() const { return tenniel::is_finite(a_) && tenniel::is_finite(b_); }

 private:
  enum class Kind : uint8_t { none, principled, conductor };
  Fresnel(Kind kind, Spectrum a, Spectrum b) : kind_(kind), a_(a), b_(b) {}

  Kind kind_ = Kind::none;
  Spectrum a_;  // cspec0, or eta
  Spectrum b_;  // (ior, f0, 1 / (1 - f0)), or k
};

}  // namespace tenniel
