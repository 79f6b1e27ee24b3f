// SPDX-License-Identifier: Apache-2.0
#include "integrator/empty_space.h"

#include <algorithm>

#include "image/voxel_grid.h"

namespace tenniel {

EmptySpace::EmptySpace(const Scene& scene, const MediumStack& media, const Ray& ray, float skipped,
                       WorldIndex world) {
  if (scene.worlds[world].material.has_volume) return;
  size_t count = 0;
  for (const MediumStack::Entry& entry : media) {
    const Instance& instance = scene.instances[entry.instance];
    const Material& material = scene.materials[instance.material(entry.slot, world)];
    // A spline reaches further than the grid's table of empty space allows for.
    const bool is_known = instance.is_void_beyond_grids && instance.motion.empty() &&
                          material.grid_filter == GridFilter::linear;
    if (!is_known) return;
    for (const PlacedGrid& grid : instance.grids) {
      if (count == k_max_grids) return;
      rays_[count++] = {grid.voxels, grid.from_world.point(ray.at(-skipped)),
                        grid.from_world.vector(ray.direction)};
    }
  }
  count_ = count;
}

float EmptySpace::until(float t) const {
  if (count_ == 0) return t;
  float empty = k_infinity;
  for (size_t i = 0; i < count_ && empty > 0.0f; ++i) {
    const GridRay& ray = rays_[i];
    empty = std::min(empty, ray.grid->empty_until(ray.origin + ray.direction * t, ray.direction));
  }
  return t + empty;
}

}  // namespace tenniel
