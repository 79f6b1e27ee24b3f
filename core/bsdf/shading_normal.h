// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/numeric.h"
#include "math/vec.h"

namespace tenniel {

// `normal` turned towards `geometric_normal` just enough that the mirror direction of `wo` rises a
// little above the surface; then `wo` lies above the result too. All unit length; `wo` and
// `geometric_normal` on one side. Unchanged where nothing is wrong.
//
// In the plane of both normals (z = the geometric one) a normal at angle phi from z reflects `wo`
// to height wo.x sin(2 phi) + wo.z cos(2 phi) = r cos(2 phi - psi), which is `height` at 2 phi =
// psi + acos(height / r): the only such angle on the way from `normal` to z.
inline Vec3 ensure_valid_reflection(Vec3 geometric_normal, Vec3 wo, Vec3 normal) {
  const float cos_geometric = dot(geometric_normal, wo);
  const float height = std::min(0.9f * cos_geometric, 0.01f);
  if (dot(normal, wo) > 0.0f && dot(geometric_normal, reflect(wo, normal)) >= height) return normal;
  const Vec3 off = normal - geometric_normal * dot(normal, geometric_normal);
  const float off_length = length(off);
  if (!(off_length > 1e-6f)) return geometric_normal;
  const Vec3 x_axis = off / off_length;
  const float wo_x = dot(wo, x_axis), wo_z = cos_geometric;
  const float r2 = sqr(wo_x) + sqr(wo_z);
  if (!(r2 > 1e-12f)) return geometric_normal;
  const float cos_double = (wo_z * height - wo_x * safe_sqrt(r2 - sqr(height))) / r2;
  return normalize(x_axis * safe_sqrt(0.5f * (1.0f - cos_double)) +
                   geometric_normal * safe_sqrt(0.5f * (1.0f + cos_double)));
}

// Softens the edge of light on diffuse lobes whose normal leaves the shading normal (Chiang, Li,
// Burley 2019, "Taming the Shadow Terminator", eq. 3). Symmetric in the side of the surface, hence
// for light that passes through as well.
inline float bump_shadowing(Vec3 shading_normal, Vec3 lobe_normal, Vec3 wi) {
  const float g =
      safe_divide(dot(shading_normal, wi), dot(lobe_normal, wi) * dot(shading_normal, lobe_normal));
  if (g >= 1.0f) return 1.0f;
  if (!(g > 0.0f)) return 0.0f;
  return g * (1.0f + g * (1.0f - g));
}

}  // namespace tenniel
