// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/worker.h"
#include "scene/description.h"
#include "scene/scene.h"

// From a surface to a light: where the ray starts, and what the surfaces on its way leave of it.
namespace tenniel {

// Where the facets of a smooth surface are about to hide it from the light, the shadow ray starts
// from the smooth surface instead: Cycles' geometry offset of the shadow terminator, with its blend
// from the one to the other.
Vec3 shadow_ray_origin(const SurfaceInteraction& at, Vec3 wi);

// Share of the light that reaches `ray.t_max` in `world`; surfaces dim it by their transparency.
Spectrum transmittance(const Scene& scene, const RenderSettings& settings, const Ray& ray,
                       WorldIndex world, const PathInfo& path, Worker& worker);

// What the surface at `at` lets through; black where it stops the light.
Spectrum surface_transparency(const Scene& scene, const SurfaceInteraction& at,
                              const Material& material, const PathInfo& path,
                              ShadingContext& scratch);

}  // namespace tenniel
