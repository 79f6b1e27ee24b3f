// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/mirror.h"
#include "integrator/path_state.h"
#include "integrator/worker.h"
#include "scene/description.h"

namespace tenniel {

// The numbers that one light sample takes.
struct LightNumbers {
  float choice;
  Vec2 place;
};

// Next-event estimation for one group of lobes of the surface in `worker.surface`: light that a
// sampled light sends there in the group's world, times the group's scattering. The partner of the
// light sample's weight is the density of the same group alone.
Spectrum direct_light(const Scene& scene, const RenderSettings& settings, const PathState& state,
                      const WorldGroup& group, const ShadingPoint& point, const LightNumbers& u,
                      Worker& worker);

// Toward `light` from `point`, its radiance by its shader in `path.world`.
std::optional<LightSample> sample_light(const Scene& scene, const Light& light,
                                        const ShadingPoint& point, const PathInfo& path, Vec2 u,
                                        ShadingContext& scratch);

// Light met by chance on the segment `state.ray` up to `t_max`: lamps in its way.
Spectrum lamps_met(const Scene& scene, const PathState& state, float t_max, Worker& worker);

// Weight of an emissive surface, or of the background, met by chance.
float surface_emission_weight(const Scene& scene, const PathState& state,
                              const SurfaceInteraction& at);
float background_weight(const Scene& scene, const PathState& state);

}  // namespace tenniel
