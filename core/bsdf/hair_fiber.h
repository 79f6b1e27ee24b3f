// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"
#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// One of the two lobes of a hair as a rough dielectric cylinder (Chiang, Bitterli, Tappan, Burley
// 2016, "A Practical and Controllable Hair and Fur Model for Production Path Tracing"): what its
// surface reflects (R), or what has been inside (TT, TRT and all that follows). Both go to all
// sides. Frame: x along the hair, z off it toward the viewer.
//
// Unlike in the paper and in Blender, tilting the scales of the surface keeps the energy: the
// density follows the turned direction.
struct HairFiber {
  Spectrum absorption;            // per radius, inside
  float variance = 0.1f;          // along the hair, of what goes through once; see `from_roughness`
  float primary_variance = 0.1f;  // of the reflection
  float azimuthal_scale = 0.1f;   // of the logistic distribution around the hair
  float tilt = 0.0f;              // of the scales, radians
  float eta = 1.55f;
  float offset = 0.0f;  // [-1, 1] where the viewer's ray meets it, along y
  bool is_primary = true;

  // From the artist's numbers in [0, 1]. `coat` narrows the reflection.
  static HairFiber from_roughness(float along, float around, float coat);
  // Absorption of a hair whose many-scattered colour is `color`, and of pigments.
  static Spectrum absorption_of(Spectrum color, float roughness_around);
  static Spectrum absorption_of_melanin(float eumelanin, float pheomelanin);

  LobeClass lobe_class() const { return is_primary ? LobeClass::glossy : LobeClass::transmission; }
  static constexpr bool is_delta() { return false; }
  float roughness() const { return std::sqrt(is_primary ? primary_variance : variance); }
  bool make_valid();
  void widen(float alpha);
  Spectrum albedo(Vec3 wo) const;
  LobeEval eval(Vec3 wo, Vec3 wi) const;
  std::optional<LobeSample> sample(Vec3 wo, Vec2 u) const;

 private:
  struct Passage;  // of the viewer's ray through the hair
  // Of one order: 0 R, 1 TT, 2 TRT, 3 the rest.
  float order_variance(int order) const;
  float order_tilt(int order) const;
  float order_pdf(int order, const Passage& passage, Vec3 wi) const;
};

}  // namespace tenniel
