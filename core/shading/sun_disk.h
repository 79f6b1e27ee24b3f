// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/vec.h"

namespace tenniel {

// A part of the sky that is far brighter than the rest.
struct SunDisk {
  Vec3 direction;  // unit, toward the sun
  float half_angle = 0.0f;
};

}  // namespace tenniel
