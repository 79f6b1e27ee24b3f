// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// Where light is gathered. In a medium, or where the surface transmits, there is no hemisphere.
struct ShadingPoint {
  Vec3 position;
  Vec3 normal;                 // unit, on the side of the viewer
  bool has_hemisphere = true;  // only directions above `normal` matter
};

// A direction from a shading point to a light, before occlusion. `pdf` is per solid angle given the
// light; the probability of having chosen it is the caller's factor.
struct LightSample {
  Vec3 wi;                // unit, from the shading point
  float distance = 0.0f;  // metres; infinite for sun and environment
  Spectrum radiance;      // delta lights: radiance * solid angle, with pdf = 1
  float pdf = 0.0f;
  bool is_delta = false;
};

// A ray met the surface of a lamp.
struct LampHit {
  float t = 0.0f;
  Spectrum radiance;
};

}  // namespace tenniel
