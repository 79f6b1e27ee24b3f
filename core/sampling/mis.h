// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenniel {

// Veach 1997, eq. 9.13 with exponent 2: the weight of the strategy whose density is `pdf`.
inline float power_heuristic(float pdf, float other_pdf) {
  if (!(pdf > 0.0f)) return 0.0f;
  const float ratio = other_pdf / pdf;  // a ratio, so that neither square can overflow
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace tenniel
