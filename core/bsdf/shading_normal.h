// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/numeric.h"
#include "math/vec.h"

namespace tenniel {

// `normal` turned towards `geometric_normal` just enough that the mirror direction of `wo` rises a
// little above the surface; then `wo` lies above the result too. All unit length; `wo` and
// `geometric_normal` on one side. Unchanged where nothing is wrong.
//
// In the plane of both normals (z = the geometric one) `wo` and its mirror direction have equally
// long projections, so that the height wanted gives the latter, and the normal is what halves the
// two.
inline Vec3 ensure_valid_reflection(Vec3 geometric_normal, Vec3 wo, Vec3 normal) {
  const float cos_geometric = dot(geometric_normal, wo);
  const float height = std::min(0.9f * cos_geometric, 0.01f);
  const float cos_normal = dot(normal, wo);
  // Of the mirror direction, 2 (n.wo) n - wo.
  const float mirrored = 2.0f * cos_normal * dot(geometric_normal, normal) - cos_geometric;
  if (cos_normal > 0.0f && mirrored >= height) return normal;
  const Vec3 off = normal - geometric_normal * dot(normal, geometric_normal);
  const float off_length = length(off);
  if (!(off_length > 1e-6f)) return geometric_normal;
  const Vec3 x_axis = off / off_length;
  const float wo_x = dot(wo, x_axis), wo_z = cos_geometric;
  const float root = safe_sqrt(sqr(wo_x) + sqr(wo_z) - sqr(height));
  // The second form is the same without cancellation.
  const float x = wo_x > 0.0f ? root + wo_x : safe_divide(sqr(wo_z) - sqr(height), root - wo_x);
  return normalize_or(x_axis * x + geometric_normal * (wo_z + height), geometric_normal);
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
