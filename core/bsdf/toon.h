// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "math/frame.h"
#include "math/numeric.h"
#include "sampling/warp.h"

namespace tenniel {

// Flat tones as Blender draws them: light counts the same within a cone and fades linearly with the
// angle in a rim around it. Sizes are shares of a right angle. No cosine: the model is not
// physical.
struct ToonCone {
  float size = 0.5f, smooth = 0.0f;

  bool make_valid() {
    if (!std::isfinite(size) || !std::isfinite(smooth)) return false;
    size = saturate(size);
    smooth = saturate(smooth);
    return size + smooth > 1e-4f;
  }
  LobeEval eval(Vec3 axis, Vec3 wi) const {
    const float angle = safe_acos(dot(axis, wi));
    if (!(angle <= outer_angle())) return {};
    const float pdf = uniform_cone_pdf(one_minus_cos());
    return {Spectrum(pdf * intensity(angle)), pdf};
  }
  LobeSample sample(Vec3 axis, Vec2 u) const {
    const Vec3 wi = Frame::from_normal(axis).to_world(warp_uniform_cone(u, one_minus_cos()));
    const float angle = std::min(safe_acos(dot(axis, wi)), outer_angle());
    return {wi, Spectrum(intensity(angle)), uniform_cone_pdf(one_minus_cos())};
  }
  // Mean intensity over the cone.
  float mean() const {
    const float a = inner_angle(), b = outer_angle(), s = rim();
    float sum = 1.0f - std::cos(a);
    if (s > 0.0f)
      sum += std::cos(a) - (1.0f - (b - a) / s) * std::cos(b) + (std::sin(a) - std::sin(b)) / s;
    return std::clamp(sum / one_minus_cos(), 1e-3f, 1.0f);
  }

 private:
  static constexpr float k_half_pi = 0.5f * k_pi;
  float inner_angle() const { return size * k_half_pi; }
  float rim() const { return smooth * k_half_pi; }
  float outer_angle() const { return std::min(inner_angle() + rim(), k_half_pi); }
  float one_minus_cos() const { return 2.0f * sqr(std::sin(0.5f * outer_angle())); }
  float intensity(float angle) const {
    if (angle < inner_angle()) return 1.0f;
    return smooth > 0.0f ? std::max(1.0f - (angle - inner_angle()) / rim(), 0.0f) : 0.0f;
  }
};

// The cone stands around the normal.
struct DiffuseToon {
  ToonCone cone;

  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  bool make_valid() { return cone.make_valid(); }
  static void widen(float) {}
  Spectrum albedo(Vec3) const { return Spectrum(cone.mean()); }
  LobeEval eval(Vec3, Vec3 wi) const {
    return wi.z > 0.0f ? cone.eval({0.0f, 0.0f, 1.0f}, wi) : LobeEval{};
  }
  std::optional<LobeSample> sample(Vec3, Vec2 u) const {
    const LobeSample s = cone.sample({0.0f, 0.0f, 1.0f}, u);
    return s.wi.z > 0.0f ? std::optional(s) : std::nullopt;
  }
};

// The cone stands around the mirror direction.
struct GlossyToon {
  ToonCone cone;

  static constexpr LobeClass lobe_class() { return LobeClass::glossy; }
  static constexpr bool is_delta() { return false; }
  float roughness() const { return cone.size; }
  bool make_valid() { return cone.make_valid(); }
  static void widen(float) {}
  Spectrum albedo(Vec3) const { return Spectrum(cone.mean()); }
  LobeEval eval(Vec3 wo, Vec3 wi) const {
    return wi.z > 0.0f ? cone.eval(mirrored(wo), wi) : LobeEval{};
  }
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const {
    const LobeSample s = cone.sample(mirrored(wo), u);
    return s.wi.z > 0.0f ? std::optional(s) : std::nullopt;
  }

 private:
  static Vec3 mirrored(Vec3 wo) { return {-wo.x, -wo.y, wo.z}; }
};

}  // namespace tenniel
