// SPDX-License-Identifier: Apache-2.0
// The rays of shader nodes, answered by the scene.
#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace tenniel {

bool Scene::is_free(const SurfaceInteraction& from, Vec3 direction, float distance,
                    WorldIndex world, bool own_only) const {
  if (!accel || !from.instance || !is_finite(direction)) return true;
  Ray ray;
  ray.origin = offset_ray_origin(from, direction);
  ray.direction = direction;
  ray.t_max = distance;
  ray.time = from.time;
  if (!own_only) return !accel->occluded(ray, ray_mask(world, RayKind::shadow));
  const uint32_t own = index_of(*from.instance);
  const Transform to_object = from.world_to_object();
  return !accel->intersect_instance(ray, own, &to_object);
}

size_t Scene::own_hits(const SurfaceInteraction& from, const Ray& ray,
                       std::span<OwnHit> hits) const {
  if (!accel || !from.instance || !is_finite(ray.origin) || !is_finite(ray.direction)) return 0;
  const uint32_t own = index_of(*from.instance);
  const Transform to_object = from.world_to_object();
  Ray rest = ray;
  rest.time = from.time;
  size_t count = 0;
  while (count < hits.size()) {
    const auto hit = accel->intersect_instance(rest, own, &to_object);
    if (!hit) break;
    const SurfaceInteraction at = interaction(rest, *hit, 0.0f);
    const float side = at.is_back_facing ? -1.0f : 1.0f;
    hits[count++] = {at.position, at.geometric_normal * side, at.shading_normal * side};
    // Past this one, by no more than the error of the intersection.
    const Vec3 o = at.position;
    const float extent = std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z), hit->t});
    rest.t_min = hit->t + 1e-6f * extent;
    if (!(rest.t_min < rest.t_max)) break;
  }
  return count;
}

}  // namespace tenniel
