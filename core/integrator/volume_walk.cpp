// SPDX-License-Identifier: Apache-2.0
#include "integrator/volume_walk.h"

#include "integrator/limits.h"
#include "integrator/volume_light.h"

namespace tenniel {

namespace {

// Apart from the dimensions of the surfaces, whose numbers stay the same with and without media.
constexpr uint32_t k_first_dimension = 1u << 16;
constexpr uint32_t k_dimensions_per_segment = 12;
constexpr uint32_t k_light_dimensions = 4, k_share_dimension = k_dimensions_per_segment - 1;
// Later parts of a segment come behind those of all segments.
constexpr uint32_t k_dimensions_per_part = 1u << 16;

uint32_t dimension_of(const PathState& state, uint32_t part) {
  return k_first_dimension + part * k_dimensions_per_part +
         state.vertices * k_dimensions_per_segment;
}

}  // namespace

// A path that has reached a limit is only dimmed.
VolumeWalk::VolumeWalk(const Scene& scene, const RenderSettings& settings, const PathState& state,
                       float length, uint32_t part, Worker& worker)
    : scene_(scene),
      settings_(settings),
      first_dimension_(dimension_of(state, part)),
      skipped_(state.skipped_before),
      segment_(worker.medium_steps, scene, state.media, state.ray, state.skipped_before,
               state.skipped_before + length, state.throughput, !state.ends_after_transparent,
               state.info, worker.light) {}

Spectrum VolumeWalk::lamp_light(const PathState& state, Worker& worker) const {
  if (!(segment_.scatter_probability() > 0.0f)) return {};
  // The dense parts of a cut segment share one light, each in proportion to what it scatters.
  float share = 1.0f;
  if (segment_.is_cut() && segment_.scatter_probability() > 0.5f) {
    share = segment_.scatter_probability();
    worker.sampler.set_dimension(first_dimension_ + k_share_dimension);
    if (worker.sampler.get_1d() >= share) return {};
  }
  worker.sampler.set_dimension(first_dimension_);
  return light_scattered_in(scene_, settings_, state, segment_, worker) * (1.0f / share);
}

MediumEvent VolumeWalk::advance(PathState& state, Worker& worker) const {
  Sampler& sampler = worker.sampler;
  sampler.set_dimension(first_dimension_ + k_light_dimensions);
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
  state.origin_saw_many_lights = false;
  state.min_pdf = std::min(state.min_pdf, s.eval.pdf);
  state.cone.radius = state.cone.radius_at(t);
  state.begin_segment(state.ray.at(t), s.wi);
  state.skipped_before = 0.0f;
  state.origin = {state.ray.origin, s.wi, false};
  return MediumEvent::scattered;
}

}  // namespace tenniel
