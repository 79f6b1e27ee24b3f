// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "math/numeric.h"
#include "math/vec.h"

namespace tenniel {

// The two lobes of Blender's Hair BSDF: along the strand (x of the frame) a Cauchy distribution of
// the half angle around `offset`; around it a cosine of width `roughness_v` on the side of the
// viewer (R), or a Cauchy distribution on the far side (TT).
struct HairLobe {
  float roughness_u = 0.1f, roughness_v = 1.0f;
  float offset = 0.0f;
  float tilt = 0.0f;  // sine of the angle between the strand and the surface
  bool is_transmission = false;
  bool is_round = false;  // on a hair: goes all around it, else to its side of the surface alone

  LobeClass lobe_class() const {
    return is_transmission ? LobeClass::transmission : LobeClass::glossy;
  }
  static constexpr bool is_delta() { return false; }
  float roughness() const { return std::max(roughness_u, roughness_v); }
  bool make_valid() {
    if (!std::isfinite(roughness_u) || !std::isfinite(roughness_v)) return false;
    if (!std::isfinite(offset) || !std::isfinite(tilt)) return false;
    roughness_u = std::clamp(roughness_u, 0.001f, 1.0f);
    roughness_v = std::clamp(roughness_v, 0.001f, 1.0f);
    tilt = std::clamp(tilt, -1.0f, 1.0f);
    return true;
  }
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }

  LobeEval eval(Vec3 wo, Vec3 wi) const {
    if (!is_round && (is_transmission ? !(wi.z < 0.0f) : !(wi.z > 0.0f))) return {};
    Strand strand;
    if (!strand.set(tilt, wo)) return {};
    const float along = dot(strand.axis, wi);
    const Vec3 around = wi - strand.axis * along;
    const float cos_theta = length(around);
    if (!(cos_theta > k_min_cos)) return {};
    const float theta = std::asin(std::clamp(along, -1.0f, 1.0f));
    const float phi = safe_acos(dot(around, strand.toward) / cos_theta);
    const float along_pdf = pdf_along(strand.theta, theta) / cos_theta;
    if (!is_transmission) {
      const float pdf = along_pdf * reflected_around(phi);
      return {Spectrum(pdf), pdf};
    }
    const float around_pdf = cauchy_around(phi, k_pi);
    return {Spectrum(along_pdf * cauchy_around(phi, k_half_pi)), along_pdf * around_pdf};
  }

  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    Strand strand;
    if (!strand.set(tilt, wo)) return std::nullopt;
    const Limits limits = limits_at(strand.theta);
    const float half = roughness_u * std::tan(lerp(limits.low, limits.high, u.x)) + offset;
    const float theta = 2.0f * half - strand.theta;
    const float phi = is_transmission
                          ? k_pi + roughness_v * std::tan(azimuth_limit(k_pi) * (2.0f * u.y - 1.0f))
                          : 2.0f * roughness_v * safe_asin(1.0f - 2.0f * u.y);
    const float cos_theta = std::cos(theta);
    const Vec3 side = cross(strand.toward, strand.axis);
    const Vec3 wi = normalize(strand.toward * (std::cos(phi) * cos_theta) -
                              side * (std::sin(phi) * cos_theta) + strand.axis * std::sin(theta));
    // What the other half of the sphere gets belongs to nobody.
    const LobeEval e = eval(wo, wi);
    if (!(e.pdf > 0.0f) || !std::isfinite(e.pdf)) return std::nullopt;
    return LobeSample{wi, e.value / e.pdf, e.pdf};
  }

 private:
  static constexpr float k_half_pi = 0.5f * k_pi;
  static constexpr float k_min_cos = 0.001f;

  // The strand seen from `wo`.
  struct Strand {
    Vec3 axis, toward;  // `toward`: wo projected off the strand, unit
    float theta = 0.0f;
    bool set(float tilt_sine, Vec3 wo) {
      axis = {safe_sqrt(1.0f - sqr(tilt_sine)), 0.0f, tilt_sine};
      const float along = std::clamp(dot(axis, wo), -1.0f, 1.0f);
      const Vec3 across = wo - axis * along;
      if (!(length_squared(across) > 1e-12f)) return false;
      toward = normalize(across);
      theta = std::asin(along);
      return true;
    }
  };
  struct Limits {
    float low, high;  // of the Cauchy distribution's angle, where theta reaches the poles
  };
  Limits limits_at(float theta_o) const {
    return {std::atan((0.5f * (theta_o - k_half_pi) - offset) / roughness_u),
            std::atan((0.5f * (theta_o + k_half_pi) - offset) / roughness_u)};
  }
  float azimuth_limit(float widest) const { return std::atan(widest / roughness_v); }

  float pdf_along(float theta_o, float theta_i) const {
    const Limits limits = limits_at(theta_o);
    const float t = 0.5f * (theta_i + theta_o) - offset;
    return roughness_u / (2.0f * (sqr(t) + sqr(roughness_u)) * (limits.high - limits.low));
  }
  // Around the far side; Blender's value is that of a quarter turn to either side but reaches
  // farther, its samples go as far as the value does.
  float cauchy_around(float phi, float widest) const {
    return roughness_v / (2.0f * azimuth_limit(widest) * (sqr(k_pi - phi) + sqr(roughness_v)));
  }
  float reflected_around(float phi) const {
    if ((!is_round && phi > k_half_pi) || phi > k_pi * roughness_v) return 0.0f;
    return 0.25f * std::max(std::cos(0.5f * phi / roughness_v), 0.0f) / roughness_v;
  }
};

}  // namespace tenniel
