// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numeric.h"
#include "math/spectrum.h"

namespace tenniel {

// How far from its entry diffuse light leaves a flat surface: Christensen & Burley 2015,
// "Approximate Reflectance Profiles for Efficient Subsurface Scattering", eq. 3, with a length for
// each channel, cut off at 16 lengths and normalised. Distances are sampled from the mean of the
// channels that take part.
class BurleyProfile {
 public:
  explicit BurleyProfile(Spectrum lengths) : lengths_{lengths.r, lengths.g, lengths.b} {
    for (const float d : lengths_)
      channels_ += d > 0.0f ? 1 : 0;
  }

  // Whether there is a channel to sample.
  bool empty() const { return channels_ == 0; }
  // Density per metre of distance in each channel.
  Spectrum density(float r) const {
    return {density(lengths_[0], r), density(lengths_[1], r), density(lengths_[2], r)};
  }
  // Density of `sample`.
  float pdf(float r) const {
    const Spectrum each = density(r);
    return (each.r + each.g + each.b) / static_cast<float>(channels_);
  }
  struct Distance {
    float r = 0.0f, farthest = 0.0f;  // metres; of the channel that was chosen
  };
  // Must not be called without a channel.
  Distance sample(float u) const {
    u *= static_cast<float>(channels_);
    float length = 0.0f;
    for (const float d : lengths_) {
      if (!(d > 0.0f)) continue;
      length = d;
      if (u < 1.0f) break;
      u -= 1.0f;
    }
    return {length * invert(std::min(u, k_one_minus_epsilon) * k_share), length * k_end};
  }

 private:
  static constexpr float k_end = 16.0f;            // lengths
  static constexpr float k_share = 0.9963790094f;  // of the whole profile, up to there

  static float density(float d, float r) {
    if (!(d > 0.0f) || r >= k_end * d) return 0.0f;
    const float far = std::exp(r / (-3.0f * d)), near = far * far * far;
    return (near + far) / (4.0f * d * k_share);
  }
  // Solves u = 1 - (exp(-x) + 3 exp(-x / 3)) / 4: a cubic in y = exp(-x / 3) without its square,
  // whose one real root is 2 sinh(asinh(2 (1 - u)) / 3).
  static float invert(float u) {
    const float y = 2.0f * std::sinh(std::asinh(2.0f * (1.0f - u)) / 3.0f);
    return -3.0f * std::log(std::min(y, 1.0f));
  }

  std::array<float, 3> lengths_;
  int channels_ = 0;
};

}  // namespace tenniel
