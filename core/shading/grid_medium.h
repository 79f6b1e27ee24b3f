// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/spectrum.h"
#include "media/medium.h"

namespace tenniel {

// Smoke as most artists make it: the same everywhere but for a grid that says how dense it is. It
// is known without running a shader.
struct GridMedium {
  int density = -1;         // id of the grid
  MediumProperties medium;  // where that holds 1, without
  Spectrum emission;        // which is the same whatever it holds
};

}  // namespace tenniel
