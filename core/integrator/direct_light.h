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

// Toward `light` from `point` of the path `at`, its radiance by its shader in `world`.
std::optional<LightSample> sample_light(const Scene& scene, const Light& light,
                                        const ShadingPoint& point, const PathInfo& at,
                                        WorldIndex world, Vec2 u, Worker& worker);

// Radiance of a lamp that the ray has met, times the weight of having met it by chance.
Spectrum lamp_met(const Scene& scene, const PathState& state, uint32_t index, const LampHit& hit,
                  Worker& worker);

// Light met by chance on the segment `state.ray` up to `t_max`: lamps in its way.
inline Spectrum lamps_met(const Scene& scene, const PathState& state, float t_max, Worker& worker) {
  Spectrum sum;
  for (const uint32_t index : scene.hittable_lamps) {
    const Light& light = scene.lights[index];
    if (!light.visibility.seen_by(state.info.world, state.info.kind)) continue;
    const auto hit = intersect_lamp(light, state.ray);
    // A sun lies behind everything: only a ray that meets nothing gets there.
    if (!hit || hit->t > t_max || (hit->t == k_infinity && t_max < k_infinity)) continue;
    sum += lamp_met(scene, state, index, *hit, worker);
  }
  return sum;
}

// Weight of an emissive surface, or of the background, met by chance.
float surface_emission_weight(const Scene& scene, const PathState& state,
                              const SurfaceInteraction& at);
float background_weight(const Scene& scene, const PathState& state);

}  // namespace tenniel
