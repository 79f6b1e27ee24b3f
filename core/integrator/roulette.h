// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "integrator/radiance_cache.h"
#include "math/spectrum.h"

// Roulette against what is already known. A path expected to bring C goes on with probability p and
// brings C + (X - C) / p; otherwise it brings C. The mean is that of X whatever C is, and the noise
// that the roulette adds is that of X - C alone, so that paths of small consequence end early. p
// follows how much they would change the pixel (after Vorba & Krivanek 2016, "Adjoint-Driven
// Russian Roulette and Splitting").
namespace tenniel {

// Measured in a closed room: where noise times time is least, 0.75 of Cycles' noise. At 1.3 the
// noise is Cycles' and the time 0.85 of this.
constexpr float k_roulette_effort = 2.0f;
// What the neighbourhood does not show may still be there: no ray is made rarer than this, and none
// rarer than this share of what its throughput says.
constexpr float k_min_probability = 0.1f;
constexpr float k_least_share = 0.25f;

// The change of a pixel that is worth going on for, in between equal absolute noise everywhere and
// equal noise relative to the pixel: about equal noise as displayed.
inline float worthwhile_change(Spectrum pixel, float picture_mean) {
  return std::sqrt(std::max(max_component(pixel), 0.0f) * picture_mean) / k_roulette_effort;
}

// Probability of tracing what would change the pixel by about `deviation`; `least`: not below.
inline float roulette_probability(float deviation, float worthwhile, float least) {
  if (!(worthwhile > 0.0f)) return 1.0f;
  return std::clamp(deviation / worthwhile, std::max(least, k_min_probability), 1.0f);
}

}  // namespace tenniel
