// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/numeric.h"
#include "math/vec.h"

// The GGX (Trowbridge-Reitz) microsurface, anisotropic, in a frame with z = the mean normal.
// [Heitz 2014] "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs".
// [Dupuy & Benyoub 2023] "Sampling Visible GGX Normals with Spherical Caps".
namespace tenniel::ggx {

// D(m) [Heitz 2014, eq. 85], written with the slopes so that small alphas keep their precision.
inline float normal_density(Vec3 m, float alpha_x, float alpha_y) {
  if (m.z <= 0.0f) return 0.0f;
  const float slope2 = sqr(m.x / alpha_x) + sqr(m.y / alpha_y) + sqr(m.z);
  return 1.0f / (k_pi * alpha_x * alpha_y * sqr(slope2));
}

// Area of the microsurface visible from `w`, projected on it: |cos| (1 + Lambda) [Heitz 2014,
// eqs. 14, 42, 86]. Never 0 for a rough surface, so that grazing angles need no special case.
inline float visible_area(Vec3 w, float alpha_x, float alpha_y) {
  const float stretched2 = sqr(alpha_x * w.x) + sqr(alpha_y * w.y) + sqr(w.z);
  return 0.5f * (std::abs(w.z) + std::sqrt(stretched2));
}

// Facets as seen from `wo` (wo.z > 0), density D(m) (wo.m) / visible_area(wo) [Dupuy & Benyoub
// 2023, listing 3]: on the unit hemisphere, the normals seen are the halves between `wo` and a cap.
inline Vec3 sample_visible_normal(Vec3 wo, float alpha_x, float alpha_y, Vec2 u) {
  const Vec3 stretched = normalize({alpha_x * wo.x, alpha_y * wo.y, wo.z});
  const float phi = k_two_pi * u.x;
  const float height = (1.0f - u.y) * (1.0f + stretched.z);  // above the cap's rim
  const float cap_z = height - stretched.z;
  const float sin_theta = safe_sqrt(1.0f - sqr(cap_z));
  const Vec3 half{sin_theta * std::cos(phi) + stretched.x, sin_theta * std::sin(phi) + stretched.y,
                  height};
  return normalize({alpha_x * half.x, alpha_y * half.y, half.z});
}

}  // namespace tenniel::ggx
