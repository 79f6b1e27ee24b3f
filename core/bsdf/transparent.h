// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"

namespace tenniel {

// Passes straight through as if nothing were there.
struct Transparent {
  static constexpr LobeClass lobe_class() { return LobeClass::transparent; }
  static constexpr bool is_delta() { return true; }
  static constexpr float roughness() { return 0.0f; }
  static constexpr bool make_valid() { return true; }
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }
  static LobeEval eval(Vec3, Vec3) { return {}; }
  static std::optional<LobeSample> sample(Vec3 wo, Vec2) { return LobeSample{-wo, Spectrum(1.0f)}; }
};

}  // namespace tenniel
