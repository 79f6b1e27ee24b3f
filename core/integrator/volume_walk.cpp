// SPDX-License-Identifier: Apache-2.0
#include "integrator/volume_walk.h"

#include "integrator/limits.h"
#include "integrator/volume_light.h"

namespace tenniel {

namespace {

// Apart from the dimensions of the surfaces, whose numbers stay the same with and without media.
constexpr uint32_t k_first_dimension = 1u << 16;
constexpr uint32_t k_dimensions_per_segment = 12;
constexpr uint32_t k_light_dimensions = 4;

uint32_t dimension_of(const PathState& state) {
  return k_first_dimension + state.vertices * k_dimensions_per_segment;
}

}  // namespace

// A path that has reached a limit is only dimmed.
VolumeWalk::VolumeWalk(const Scene& scene, const RenderSettings& settings, const PathState& state,
                       float length, Worker& worker)
    : scene_(scene),
      settings_(settings),
      segment_(worker.medium_steps, scene, state.media, state.ray, state.skipped_before,
               state.skipped_before + length, state.throughput, !state.ends_after_transparent,
               state.info, worker.light) {}

Spectrum VolumeWalk::lamp_light(const PathState& state, Worker& worker) const {
  if (!(segment_.scatter_probability() > 0.0f)) return {};
  worker.sampler.set_dimension(dimension_of(state));
  return light_scattered_in(scene_, settings_, state, segment_, worker);
}

MediumEvent VolumeWalk::advance(PathState& state, Worker& worker) const {
  Sampler& sampler = worker.sampler;
  sampler.set_dimension(dimension_of(state) + k_light_dimensions);
  const float probability = segment_.scatter_probability();
  if (!(probability > 0.0f) || sampler.get_1d() >= probability) {
    state.throughput *= segment_.transmittance() * (1.0f / (1.0f - probability));
    return max_component(state.throughput) > 0.0f ? MediumEvent::passed : MediumEvent::ended;
  }
  const float flown = segment_.sample(sampler.get_1d());
  const float t = std::max(flown - state.skipped_before, 0.0f);
  const float u_lobe = sampler.get_1d();
  const PhaseFunction& phase = segment_.medium_at(flown).phase;
  if (phase.empty()) return MediumEvent::ended;
  const PhaseSample s = phase.sample(state.ray.direction, u_lobe, sampler.get_2d());
  if (!(s.eval.pdf > 0.0f)) return MediumEvent::ended;
  state.throughput *= segment_.transmittance_to(flown) * s.eval.value *
                      (1.0f / (segment_.pdf(flown) * probability * s.eval.pdf));
  if (!(max_component(state.throughput) > 0.0f)) return MediumEvent::ended;
  count_volume_bounce(state, settings_);
  state.pdf = s.eval.pdf;
  state.min_pdf = std::min(state.min_pdf, s.eval.pdf);
  state.cone.radius = state.cone.radius_at(t);
  state.ray.origin = state.ray.at(t);
  state.ray.behind = 0.0f;
  state.left = {};
  state.ray.direction = s.wi;
  state.ray.t_min = state.skipped_before = 0.0f;
  state.ray.t_max = k_infinity;
  state.length_before = 0.0f;
  state.origin = {state.ray.origin, s.wi, false};
  return MediumEvent::scattered;
}

}  // namespace tenniel
