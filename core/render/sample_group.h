// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "integrator/worker.h"

namespace tenniel {

// Samples of a pixel that see the same through the camera.
struct SampleGroup {
  uint32_t first = 0, count = 1;
  uint32_t camera_ray = 0;  // of the pixel: the samples of their own and the groups before
};

// The first samples see each for itself: edges and textures need them most. From there on a pixel
// is known better than its light, and a second path from the same surface costs less than another
// look at it. Measured at 128 samples, time and variance against a look for each:
// procedural_spheres 0.85 and 1.00, textured_spheres 0.90 and 1.04, material_grid 0.97 and 0.98,
// bench_room 0.97 and 1.01.
constexpr uint32_t k_samples_alone = 8;

// The group that begins at sample `first` of a pixel and goes no further than to `end`.
constexpr SampleGroup sample_group(uint32_t first, uint32_t end, bool may_share) {
  if (!may_share || first < k_samples_alone) return {first, 1, first};
  constexpr uint32_t size = k_max_branches;
  const uint32_t since = first - k_samples_alone;
  return {first, std::min(size - since % size, end - first), k_samples_alone + since / size};
}

}  // namespace tenniel
