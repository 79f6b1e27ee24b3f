// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/lobe_class.h"
#include "bsdf/lobe_sample.h"

namespace tenniel {

// How light finds its way below a surface. Both walks are one; their mean free paths differ.
enum class SubsurfaceMethod : uint8_t { christensen_burley, fixed_radius_walk, random_walk };

// Radii below this, in metres, are those of a diffuse surface.
constexpr float k_min_subsurface_radius = 1e-8f;

// Factor from the radius that a shader asks for to the mean free path of a walk, or to the length
// in the profile. `color` is the albedo of the surface in one channel, `ior` within [1.01, 3.8].
float subsurface_radius_scale(SubsurfaceMethod method, float color, float ior);

// Light that enters the object and leaves it elsewhere. Here it is only one lobe to choose among:
// the direction of its sample is the lobe's normal, and the integrator takes the path to its exit.
struct Subsurface {
  SubsurfaceMethod method = SubsurfaceMethod::random_walk;
  bool has_fresnel = false;  // where light leaves, as Principled has it
  Spectrum color;            // albedo of the surface
  Spectrum radius;           // metres: mean free path, or length in the profile; 0: no such channel
  float anisotropy = 0.0f;

  static constexpr LobeClass lobe_class() { return LobeClass::diffuse; }
  static constexpr bool is_delta() { return true; }
  static constexpr float roughness() { return 1.0f; }
  bool make_valid();
  static void widen(float) {}
  static Spectrum albedo(Vec3) { return Spectrum(1.0f); }
  static LobeEval eval(Vec3, Vec3) { return {}; }
  static std::optional<LobeSample> sample(Vec3, Vec2) {
    return LobeSample{{0.0f, 0.0f, 1.0f}, Spectrum(1.0f), 1.0f};
  }
};

}  // namespace tenniel
