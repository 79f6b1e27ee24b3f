// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "math/numeric.h"

namespace tenniel {

// Guides a walk through a dense medium towards a flat boundary (Krivanek & d'Eon 2014, "A
// Zero-variance-based Sampling Scheme for Monte Carlo Subsurface Scattering"; Meng et al. 2016,
// "Improving the Dwivedi Sampling Scheme"). The longer light diffuses, the less it guides.
class Dwivedi {
 public:
  // `albedo`: of single scattering, within [0.2, 1).
  explicit Dwivedi(float albedo)
      : length_(diffusion_length(albedo)), log_ratio_(std::log1p(2.0f / (length_ - 1.0f))) {}

  // In mean free paths (d'Eon & Krivanek 2020, "Zero-Variance Theory for Efficient Subsurface
  // Scattering", eq. 67: a fit).
  float length() const { return length_; }
  // Cosine with the direction to the boundary.
  float sample(float u) const {
    return std::clamp(length_ - (length_ + 1.0f) * std::exp(-u * log_ratio_), -1.0f, 1.0f);
  }
  // Per solid angle: the azimuth is uniform.
  float pdf(float cosine) const { return 0.5f * k_inv_pi / ((length_ - cosine) * log_ratio_); }
  // Factor on the extinction by which the next distance is sampled.
  float stretching(float cosine) const { return 1.0f - cosine / length_; }

 private:
  static float diffusion_length(float albedo) {
    const float exponent = 2.44294f - 0.0215813f * albedo + 0.578637f / albedo;
    return 1.0f / std::sqrt(1.0f - std::pow(albedo, exponent));
  }
  float length_, log_ratio_;
};

}  // namespace tenniel
