// SPDX-License-Identifier: Apache-2.0
#include "bsdf/subsurface.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"

namespace tenniel {

namespace {

// Total diffuse reflectance of a half-space by the dipole, from the reduced single-scattering
// albedo (Jensen et al. 2001, "A Practical Model for Subsurface Light Transport", section 2.4).
float dipole_reflectance(float albedo, float four_thirds_a) {
  const float s = std::sqrt(3.0f * (1.0f - albedo));
  return 0.5f * albedo * (1.0f + std::exp(-four_thirds_a * s)) * std::exp(-s);
}

// Its inverse, to the 12 halvings that Blender's look rests on.
float dipole_albedo(float reflectance, float four_thirds_a) {
  if (reflectance < 1e-4f) return 0.0f;
  if (reflectance >= 0.995f) return 0.999999f;
  float low = 0.0f, high = 1.0f, middle = 0.5f;
  for (int i = 0; i < 12; ++i) {
    middle = 0.5f * (low + high);
    (dipole_reflectance(middle, four_thirds_a) < reflectance ? low : high) = middle;
  }
  return middle;
}

}  // namespace

float subsurface_radius_scale(SubsurfaceMethod method, float color, float ior) {
  // Blender's radius dates from wider profiles.
  if (method != SubsurfaceMethod::random_walk) return 0.25f * k_inv_pi;
  // Reflected inside of the boundary, diffuse light on the average (Jensen, eq. 2).
  const float reflected = (-1.44f / ior + 0.71f) / ior + 0.668f + 0.0636f * ior;
  const float four_thirds_a = (4.0f / 3.0f) * (1.0f + reflected) / (1.0f - reflected);
  return std::sqrt(3.0f * (1.0f - dipole_albedo(color, four_thirds_a)));
}

bool Subsurface::make_valid() {
  if (!is_finite(color) || !is_finite(radius) || !std::isfinite(anisotropy)) return false;
  color = positive(color);
  radius = positive(radius);
  anisotropy = std::clamp(anisotropy, 0.0f, 0.9f);
  return max_component(radius) > 0.0f;
}

}  // namespace tenniel
