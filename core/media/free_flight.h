// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numeric.h"
#include "math/ray.h"
#include "math/spectrum.h"

namespace tenniel {

// exp(-sigma * distance), 1 where nothing is in the way however far.
inline float beer_lambert(float sigma, float distance) {
  return sigma > 0.0f ? std::exp(-sigma * distance) : 1.0f;
}
// Most media are grey: one exponential serves all channels then.
inline bool is_grey(Spectrum s) {
  return s.r == s.g && s.g == s.b;
}
inline Spectrum beer_lambert(Spectrum sigma, float distance) {
  if (is_grey(sigma)) return Spectrum(beer_lambert(sigma.r, distance));
  return {beer_lambert(sigma.r, distance), beer_lambert(sigma.g, distance),
          beer_lambert(sigma.b, distance)};
}

// Integral of exp(-sigma t) over [0, distance]: what an emission of 1 per metre sends to its start.
// Without extinction and without end it has none: 0.
inline float emission_length(float sigma, float distance) {
  if (sigma * distance > 1e-6f) return -std::expm1(-sigma * distance) / sigma;
  return distance < k_infinity ? distance : 0.0f;
}
inline Spectrum emission_length(Spectrum sigma, float distance) {
  return {emission_length(sigma.r, distance), emission_length(sigma.g, distance),
          emission_length(sigma.b, distance)};
}

// Where light that travels [0, length) of a homogeneous medium is scattered, and whether it is.
// The density mixes those of the three channels, each as likely as the light that it scatters is
// strong (one-sample balance heuristic, Wilkie et al. 2014): the sum of the channels' throughput
// after either event is the same, so chance makes neither colour noise nor fireflies. Absorption
// dims the light and never ends a path.
class FreeFlight {
 public:
  FreeFlight() = default;
  FreeFlight(Spectrum sigma_t, Spectrum sigma_s, Spectrum throughput, float length)
      : sigma_(components(sigma_t)),
        transmittance_(beer_lambert(sigma_t, length)),
        length_(length) {
    const auto scattering = components(sigma_s), before = components(throughput);
    const auto through = components(transmittance_);
    float scattered = 0.0f, passed = 0.0f;
    for (size_t c = 0; c < 3; ++c) {
      const bool is_known = c > 0 && sigma_[c] == sigma_[c - 1];
      extinct_[c] = is_known           ? extinct_[c - 1]
                    : sigma_[c] > 0.0f ? -std::expm1(-sigma_[c] * length)
                                       : 0.0f;
      weights_[c] =
          scattering[c] > 0.0f ? before[c] * scattering[c] / sigma_[c] * extinct_[c] : 0.0f;
      scattered += weights_[c];
      passed += before[c] * through[c];
    }
    scattered_ = scattered;
    if (!(scattered > 0.0f)) return;
    for (float& w : weights_)
      w /= scattered;
    scatter_probability_ = scattered / (scattered + passed);
  }

  // Of scattering before the end; 0 in a medium that only absorbs.
  float scatter_probability() const { return scatter_probability_; }
  // Light that is scattered on the way, the channels' sum.
  float scattered() const { return scattered_; }
  // Over the whole length.
  Spectrum transmittance() const { return transmittance_; }
  // Distance to the scattering, given that there is one.
  float sample(float u) const {
    size_t c = 0;
    while (c < 2 && (u >= weights_[c] || weights_[c] == 0.0f))
      u -= weights_[c++];
    while (c > 0 && weights_[c] == 0.0f)
      --c;  // rounding left a rest behind the last channel that scatters
    const float within = std::clamp(u / weights_[c], 0.0f, k_one_minus_epsilon);
    return std::min(-std::log1p(-within * extinct_[c]) / sigma_[c], length_);
  }
  // Its density per metre.
  float pdf(float t) const {
    float sum = 0.0f;
    for (size_t c = 0; c < 3; ++c)
      if (weights_[c] > 0.0f)
        sum += weights_[c] * sigma_[c] * std::exp(-sigma_[c] * t) / extinct_[c];
    return sum;
  }

 private:
  static std::array<float, 3> components(Spectrum s) { return {s.r, s.g, s.b}; }

  std::array<float, 3> sigma_{};
  std::array<float, 3> weights_{};  // of the channels, given scattering
  std::array<float, 3> extinct_{};  // 1 - transmittance
  Spectrum transmittance_;
  float length_ = 0.0f;
  float scattered_ = 0.0f;
  float scatter_probability_ = 0.0f;
};

}  // namespace tenniel
