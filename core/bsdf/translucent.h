// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/diffuse.h"

namespace tenniel {

// Lambert's law on the far side: a thin sheet that scatters what passes.
struct Translucent {
  static constexpr LobeClass lobe_class() { return LobeClass::transmission; }
  static constexpr bool is_delta() { return false; }
  static constexpr float roughness() { return 1.0f; }
  static constexpr bool make_valid() { return true; }
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }

  static LobeEval eval(Vec3 wo, Vec3 wi) { return Diffuse::eval(wo, -wi); }
  static std::optional<LobeSample> sample(Vec3 wo, Vec2 u) {
    std::optional<LobeSample> s = Diffuse::sample(wo, u);
    if (s) s->wi = -s->wi;
    return s;
  }
};

}  // namespace tenniel
