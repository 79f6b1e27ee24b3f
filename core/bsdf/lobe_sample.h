// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// What one lobe answers, in its own frame; the conventions are those of bsdf.h without the
// probability of choosing the lobe.
struct LobeEval {
  Spectrum value;
  float pdf = 0.0f;
};

struct LobeSample {
  Vec3 wi;
  Spectrum weight;   // value / pdf
  float pdf = 1.0f;  // 1 for a delta lobe
};

}  // namespace tenniel
