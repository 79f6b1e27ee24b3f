// SPDX-License-Identifier: Apache-2.0
#include "integrator/shadow_ray.h"

namespace tenniel {

Vec3 shadow_ray_origin(const SurfaceInteraction& at, Vec3 wi) {
  if (is_on_hair(at)) return offset_ray_origin(at, wi);
  const float cutoff = at.instance->terminator_cutoff;
  const float smooth = dot(at.shading_normal, wi), flat = dot(at.geometric_normal, wi);
  if (!(smooth > 0.0f) || !(flat < cutoff)) return offset_ray_origin(at, wi);
  const float amount = smooth < cutoff ? 2.0f - (flat + smooth) / cutoff : 1.0f - flat / cutoff;
  const Vec3 above = offset_ray_origin(at, flat > 0.0f ? wi : at.geometric_normal);
  return above + to_smooth_surface(at) * saturate(amount);
}

Spectrum surface_transparency(const Scene& scene, const SurfaceInteraction& at,
                              const Material& material, const PathInfo& path,
                              ShadingContext& scratch) {
  scratch.surface = at;
  begin_surface(scene, material, path, k_query_transparency, scratch);
  material.transparency.run(scratch);
  // Blender's hairs cast grey shadows.
  return is_on_hair(at) ? Spectrum(mean(scratch.transparency)) : scratch.transparency;
}

void start_anew(Ray& ray, Vec3 end, Vec3 origin) {
  ray.behind += distance(ray.origin, origin);
  ray.origin = origin;
  ray.t_min = 0.0f;
  if (!(ray.t_max < k_infinity)) return;
  const Vec3 rest = end - origin;
  ray.t_max = dot(rest, ray.direction) > 0.0f ? length(rest) : 0.0f;
  if (ray.t_max > 0.0f) ray.direction = rest / ray.t_max;
}

Spectrum transmittance(const Scene& scene, const RenderSettings& settings, const Ray& ray,
                       WorldIndex world, const PathInfo& path, ShadingContext& scratch) {
  const uint32_t mask = ray_mask(world, RayKind::shadow);
  if (!scene.has_transparent_shadows)
    return scene.accel->occluded(ray, mask) ? Spectrum() : Spectrum(1.0f);
  const Vec3 end = ray.t_max < k_infinity ? ray.at(ray.t_max) : Vec3{};
  Spectrum through(1.0f);
  Ray rest = ray;
  PathInfo info = path;
  info.kind = RayKind::shadow;
  info.world = world;
  ++info.ray_depth;
  while (const auto hit = scene.accel->intersect(rest, mask)) {
    const SurfaceInteraction at = scene.interaction(rest, *hit, 0.0f);
    const Material& material = scene.material_at(at, world);
    const bool passes = material.is_transparent && material.use_transparent_shadow &&
                        info.transparent_depth < settings.transparent_max_bounces;
    if (!passes) return {};
    through *= surface_transparency(scene, at, material, info, scratch);
    if (!(max_component(through) > 0.0f)) return {};
    ++info.transparent_depth;
    start_anew(rest, end, offset_ray_origin(at, rest.direction));
    if (!(rest.t_max > 0.0f)) break;
  }
  return through;
}

}  // namespace tenniel
