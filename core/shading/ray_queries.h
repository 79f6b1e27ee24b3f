// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "geometry/interaction.h"
#include "geometry/visibility.h"

namespace tenniel {

// What a surface looks like where a ray met it, whatever side it was met from.
struct OwnHit {
  Vec3 position;
  Vec3 geometric_normal, shading_normal;
};

// Rays that a node may send from the point it shades: shading does not know the scene.
class RayQueries {
 public:
  // Whether `distance` metres along `direction` are free of what casts shadows in `world`, or, with
  // `own_only`, of the object itself.
  virtual bool is_free(const SurfaceInteraction& from, Vec3 direction, float distance,
                       WorldIndex world, bool own_only) const = 0;
  // Where `ray` meets the object of `from`, nearest first; the number of hits, at most hits.size().
  virtual size_t own_hits(const SurfaceInteraction& from, const Ray& ray,
                          std::span<OwnHit> hits) const = 0;
  // How far occlusion reaches where the node does not say.
  float occlusion_distance = 10.0f;

 protected:
  ~RayQueries() = default;
};

}  // namespace tenniel
