// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "integrator/medium_stack.h"
#include "math/ray.h"
#include "scene/scene.h"

namespace tenniel {

// Finds the stretches of one segment where its media hold nothing: volume objects are empty where
// their grids have no voxels, whatever their shaders say there.
class EmptySpace {
 public:
  // Distances are of a segment that `ray` joins `skipped` metres after its start.
  EmptySpace(const Scene& scene, const MediumStack& media, const Ray& ray, float skipped,
             WorldIndex world);

  // Up to where there is surely nothing from `t` on; `t` itself where something may be.
  float until(float t) const;

 private:
  // The segment in the unit cube of one grid.
  struct GridRay {
    const VoxelGrid* grid = nullptr;
    Vec3 origin, direction;
  };
  static constexpr size_t k_max_grids = 8;

  std::array<GridRay, k_max_grids> rays_;
  size_t count_ = 0;  // 0: nothing is known to be empty
};

}  // namespace tenniel
