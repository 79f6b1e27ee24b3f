// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bsdf/fresnel.h"
#include "math/numeric.h"

namespace tenniel {

// Fresnel reflectance of a boundary whose index grows from 1 without bound as `blend` goes to 1.
inline float layer_fresnel(float cos_theta, float blend, bool is_back_facing) {
  const float inverse_index = std::max(1.0f - blend, 1e-5f);
  return fresnel_dielectric(cos_theta, is_back_facing ? inverse_index : 1.0f / inverse_index);
}

// 1 where the surface is seen edge-on; `blend` 0.5 falls off linearly in the cosine.
inline float layer_facing(float cos_theta, float blend) {
  const float cosine = std::abs(cos_theta);
  if (blend == 0.5f) return 1.0f - cosine;
  const float b = std::clamp(blend, 0.0f, 1.0f - 1e-5f);
  return 1.0f - std::pow(cosine, b < 0.5f ? 2.0f * b : 0.5f / (1.0f - b));
}

}  // namespace tenniel
