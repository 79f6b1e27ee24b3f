// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "math/spectrum.h"
#include "media/phase_function.h"

namespace tenniel {

// What a medium does at a point. Coefficients are per metre, emission is radiance per metre. Media
// that overlap add up.
struct MediumProperties {
  Spectrum sigma_a, sigma_s, emission;
  PhaseFunction phase;  // its lobes' weights sum to sigma_s

  Spectrum sigma_t() const { return sigma_a + sigma_s; }
  bool is_vacuum() const { return is_black(sigma_a) && is_black(sigma_s) && is_black(emission); }

  // What is negative or not finite adds nothing.
  void add_absorption(Spectrum sigma) { sigma_a += usable(sigma); }
  void add_scattering(Spectrum sigma, float g) {
    const Spectrum s = usable(sigma);
    sigma_s += s;
    phase.add(s, std::isfinite(g) ? g : 0.0f);
  }
  void add_emission(Spectrum radiance) { emission += usable(radiance); }
  // `scale`: of all its coefficients.
  void add(const MediumProperties& other, float scale = 1.0f) {
    sigma_a += other.sigma_a * scale;
    sigma_s += other.sigma_s * scale;
    emission += other.emission * scale;
    phase.add(other.phase, scale);
  }

 private:
  static float usable(float x) { return x > 0.0f && x < 1e18f ? x : 0.0f; }
  static Spectrum usable(Spectrum s) { return {usable(s.r), usable(s.g), usable(s.b)}; }
};

}  // namespace tenniel
