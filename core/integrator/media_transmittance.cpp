// SPDX-License-Identifier: Apache-2.0
#include "integrator/media_transmittance.h"

#include "integrator/shadow_ray.h"
#include "media/free_flight.h"

namespace tenniel {

namespace {

constexpr int k_max_boundaries = 1024;

// Lets `ray` go on from `origin` to the same `end`: beside its old way it might meet the light that
// it comes from.
void start_anew(Ray& ray, Vec3 end, Vec3 origin) {
  ray.behind += distance(ray.origin, origin);
  ray.origin = origin;
  ray.t_min = 0.0f;
  if (!(ray.t_max < k_infinity)) return;
  const Vec3 rest = end - origin;
  ray.t_max = dot(rest, ray.direction) > 0.0f ? length(rest) : 0.0f;
  if (ray.t_max > 0.0f) ray.direction = rest / ray.t_max;
}

}  // namespace

Spectrum media_transmittance(const Scene& scene, const RenderSettings& settings, const Ray& ray,
                             const SegmentStart& start, const PathInfo& path,
                             ShadingContext& scratch) {
  MediumStack media = start.media;
  float skipped = start.skipped;
  const uint32_t mask = ray_mask(path.world, RayKind::shadow);
  PathInfo info = path;
  info.kind = RayKind::shadow;
  ++info.ray_depth;
  Ray rest = ray;
  if (!scene.has_transparent_shadows)
    return scene.accel->occluded(ray, mask)
               ? Spectrum()
               : segment_transmittance(scene, media, rest, skipped, skipped + rest.t_max, info,
                                       scratch);
  const Vec3 end = ray.t_max < k_infinity ? ray.at(ray.t_max) : Vec3{};
  Spectrum through(1.0f);
  for (int i = 0; i < k_max_boundaries; ++i) {
    const auto hit = scene.accel->intersect(rest, mask);
    const auto dimmed = [&](float t) {
      return segment_transmittance(scene, media, rest, skipped, skipped + t, info, scratch);
    };
    if (!hit) return through * dimmed(rest.t_max);
    const SurfaceInteraction at = scene.interaction(rest, *hit, 0.0f);
    const Material& material = scene.material_at(at, path.world);
    if (material.has_surface) {
      const bool passes = material.is_transparent && material.use_transparent_shadow &&
                          info.transparent_depth < settings.transparent_max_bounces;
      if (!passes) return {};
      through *= surface_transparency(scene, at, material, info, scratch);
      ++info.transparent_depth;
    }
    through *= dimmed(hit->t);
    start_anew(rest, end, offset_ray_origin(at, rest.direction));
    skipped = skipped_length(at, rest.origin, rest.direction);
    if (!(max_component(through) > 0.0f)) return {};
    cross_boundary(scene, at, rest.origin, path.world, media);
    if (!(rest.t_max > 0.0f)) return through;
  }
  return {};
}

SegmentStart segment_from(const Scene& scene, const SurfaceInteraction& at, Vec3 direction,
                          const MediumStack& before, WorldIndex world_before, WorldIndex world) {
  const Vec3 origin = offset_ray_origin(at, direction);
  SegmentStart start{before, skipped_length(at, origin, direction)};
  if (dot(at.geometric_normal, direction) < 0.0f)
    cross_boundary(scene, at, origin, world_before, start.media);
  if (world != world_before) start.media = media_around(scene, origin, world, start.media);
  return start;
}

}  // namespace tenniel
