// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/worker.h"
#include "scene/description.h"
#include "scene/scene.h"

// From a surface to a light: where the ray starts, and what the surfaces on its way leave of it.
namespace tenniel {

// Above the facets, by the cosines of `wi` to the shading and to the geometric normal.
Vec3 origin_on_smooth_surface(const SurfaceInteraction& at, Vec3 wi, float smooth, float flat);

// Where the facets of a smooth surface are about to hide it from the light, the shadow ray starts
// from the smooth surface instead: Cycles' geometry offset of the shadow terminator, with its blend
// from the one to the other.
inline Vec3 shadow_ray_origin(const SurfaceInteraction& at, Vec3 wi) {
  const float flat = dot(at.geometric_normal, wi);
  if (!(flat < at.instance->terminator_cutoff) || is_on_hair(at)) return offset_ray_origin(at, wi);
  const float smooth = dot(at.shading_normal, wi);
  return smooth > 0.0f ? origin_on_smooth_surface(at, wi, smooth, flat) : offset_ray_origin(at, wi);
}

// The same where surfaces may let light through.
Spectrum transmittance_of_surfaces(const Scene& scene, const RenderSettings& settings,
                                   const Ray& ray, WorldIndex world, const PathInfo& path,
                                   Worker& worker);

// Share of the light that reaches `ray.t_max` in `world`; surfaces dim it by their transparency.
inline Spectrum transmittance(const Scene& scene, const RenderSettings& settings, const Ray& ray,
                              WorldIndex world, const PathInfo& path, Worker& worker) {
  if (scene.has_transparent_shadows)
    return transmittance_of_surfaces(scene, settings, ray, world, path, worker);
  return Spectrum(scene.accel->occluded(ray, ray_mask(world, RayKind::shadow)) ? 0.0f : 1.0f);
}

// What the surface at `at` lets through; black where it stops the light.
Spectrum surface_transparency(const Scene& scene, const SurfaceInteraction& at,
                              const Material& material, const PathInfo& path,
                              ShadingContext& scratch);

}  // namespace tenniel
