// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "math/spectrum.h"
#include "math/vec.h"

// Skies in closed form. `to_sun` is a unit vector; `direction` is what the Sky Texture node gets, z
// up: its length is taken for 1. Below the horizon the sky is that of the horizon.
namespace tenniel {

// Preetham, Shirley, Smits 1999, "A Practical Analytic Model for Daylight". Turbidity 1 to 10.
class PreethamSky {
 public:
  PreethamSky() = default;
  PreethamSky(Vec3 to_sun, float turbidity);
  Spectrum radiance(Vec3 direction) const;

 private:
  // Of luminance Y and chromaticity x, y: Perez' five coefficients, and the value at the zenith.
  std::array<std::array<float, 5>, 3> shape_{};
  std::array<float, 3> zenith_{};
  float sun_theta_ = 0.0f, sun_phi_ = 0.0f;
};

// Hosek, Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance".
class HosekWilkieSky {
 public:
  HosekWilkieSky() = default;
  HosekWilkieSky(Vec3 to_sun, float turbidity, float ground_albedo);
  Spectrum radiance(Vec3 direction) const;

 private:
  std::array<std::array<float, 9>, 3> shape_{};  // of X, Y, Z
  std::array<float, 3> level_{};
  float sun_theta_ = 0.0f, sun_phi_ = 0.0f;
};

// CIE XYZ (white D65) to linear Rec.709; what lies outside of it is clipped.
Spectrum visible_color(Vec3 xyz);

}  // namespace tenniel
