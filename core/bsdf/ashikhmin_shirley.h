// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "bsdf/specular.h"
#include "math/numeric.h"

namespace tenniel {

// Ashikhmin, Shirley 2000, "An Anisotropic Phong BRDF Model", without its Fresnel term. Roughness
// alpha (x is the tangent) becomes the exponent 2 / alpha^2 - 2. A mirror where it is smooth.
struct AshikhminShirley {
  float alpha_x = 0.5f, alpha_y = 0.5f;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  bool is_delta() const { return std::max(alpha_x, alpha_y) <= k_smooth; }
  float roughness() const { return std::sqrt(alpha_x * alpha_y); }
  bool make_valid() {
    if (!std::isfinite(alpha_x) || !std::isfinite(alpha_y)) return false;
    alpha_x = std::clamp(alpha_x, k_smooth, 1.0f);
    alpha_y = std::clamp(alpha_y, k_smooth, 1.0f);
    return true;
  }
  void widen(float alpha) {
    alpha_x = std::max(alpha_x, alpha);
    alpha_y = std::max(alpha_y, alpha);
  }
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (is_delta() || !(wo.z > 0.0f) || !(wi.z > 0.0f)) return {};
    const Vec3 sum = wo + wi;
    const Vec3 half = normalize(sum);
    const float cos_half = std::max(0.5f * length(sum), 1e-6f);  // of either with the half
    const float pdf = density(half) / cos_half;
    const float higher = std::max({wo.z, wi.z, 1e-6f});
    return {Spectrum(pdf * (wi.z / higher)), pdf};
  }

  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    if (is_delta()) return SpecularReflection{}.sample(wo, u);
    if (!(wo.z > 0.0f)) return std::nullopt;
    // A quadrant at a time: the azimuth's density is symmetrical (their eq. 9).
    const float turned = 4.0f * u.x;
    const auto quadrant = static_cast<int>(turned);
    const bool falls = quadrant % 2 == 1;
    const float within = turned - static_cast<float>(quadrant);
    const float x = exponent(alpha_x), y = exponent(alpha_y);
    const float first = std::atan(std::sqrt((x + 1.0f) / (y + 1.0f)) *
                                  std::tan(0.5f * k_pi * (falls ? 1.0f - within : within)));
    const float cos_first = std::cos(first), sin_first = std::sin(first);
    const float power = x * sqr(cos_first) + y * sqr(sin_first);
    const float cos_theta = std::pow(u.y, 1.0f / (power + 1.0f));
    const float sin_theta = safe_sqrt(1.0f - sqr(cos_theta));
    const float side_x = quadrant == 1 || quadrant == 2 ? -1.0f : 1.0f;
    const float side_y = quadrant >= 2 ? -1.0f : 1.0f;
    const Vec3 half{side_x * sin_theta * cos_first, side_y * sin_theta * sin_first, cos_theta};
    const Vec3 wi = normalize(reflect(wo, half));
    const LobeEval e = eval(wo, wi);
    if (!(e.pdf > 0.0f) || !std::isfinite(e.pdf)) return std::nullopt;
    return LobeSample{wi, e.value / e.pdf, e.pdf};
  }

 private:
  static constexpr float k_smooth = 1e-4f;
  static float exponent(float alpha) { return 2.0f / sqr(alpha) - 2.0f; }
  // Of half vectors, over 4.
  float density(Vec3 half) const {
    const float x = exponent(alpha_x), y = exponent(alpha_y);
    const float sin2 = sqr(half.x) + sqr(half.y);
    const float power = sin2 > 0.0f ? (x * sqr(half.x) + y * sqr(half.y)) / sin2 : 0.0f;
    return std::sqrt((x + 1.0f) * (y + 1.0f)) / (8.0f * k_pi) *
           std::pow(std::max(half.z, 1e-6f), power);
  }
};

}  // namespace tenniel
