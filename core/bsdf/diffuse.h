// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "sampling/warp.h"

namespace tenniel {

// What the lobes share that are drawn by the cosine: `value` is theirs at `wi`.
inline std::optional<LobeSample> cosine_sample(Vec3 wi, Spectrum value) {
  const float pdf = cosine_hemisphere_pdf(wi.z);
  if (!(pdf > 0.0f)) return std::nullopt;
  return LobeSample{wi, value / pdf, pdf};
}

// Lambert's law: cos / pi.
struct Diffuse {
  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  static constexpr bool make_valid() { return true; }
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }

  static LobeEval eval(Vec3, Vec3 wi) {
    const float pdf = cosine_hemisphere_pdf(wi.z);
    return {Spectrum(pdf), pdf};
  }
  static std::optional<LobeSample> sample(Vec3, Vec2 u) {
    const Vec3 wi = warp_cosine_hemisphere(u);
    const float pdf = cosine_hemisphere_pdf(wi.z);
    if (!(pdf > 0.0f)) return std::nullopt;
    return LobeSample{wi, Spectrum(1.0f), pdf};
  }
};

}  // namespace tenniel
