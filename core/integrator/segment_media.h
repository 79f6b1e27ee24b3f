// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "integrator/medium_stack.h"
#include "media/free_flight.h"

namespace tenniel {

// A stretch of a segment that is taken as homogeneous.
struct MediumStep {
  MediumProperties medium;
  FreeFlight flight;   // from the start of the step to its end
  Spectrum before;     // transmittance from the start of the segment to that of the step
  float start = 0.0f;  // metres from the start of the segment
  float until = 0.0f;  // light scattered in this step and those before
};

// Most steps of one segment; where a medium varies over an infinite one the last has no end.
constexpr size_t k_max_medium_steps = 128;

// The media of one segment, or of its first part where they are dense: one step where they are
// homogeneous, else short ones, each with what the media are at one point of it. That point moves
// from segment to segment, so that steps do not show. Distances are from the start of the segment;
// scattering and passing are balanced as in FreeFlight.
class SegmentMedia {
 public:
  // `steps` is emptied and used: it must have room for k_max_medium_steps. `ray` starts `skipped`
  // metres after the segment. `scatters` false: light is only dimmed.
  SegmentMedia(std::vector<MediumStep>& steps, const Scene& scene, const MediumStack& media,
               const Ray& ray, float skipped, float length, Spectrum throughput, bool scatters,
               const PathInfo& path, ShadingContext& scratch);

  // Up to where the media were looked at.
  float length() const { return length_; }
  // Whether that is before the end: hardly any light is left there, or the steps are used up.
  bool is_cut() const { return is_cut_; }
  bool is_vacuum() const;
  // Radiance that glows toward the start.
  Spectrum emission() const;
  // Of being scattered before `length`; 0 where nothing scatters.
  float scatter_probability() const { return scatter_probability_; }
  Spectrum transmittance() const { return transmittance_; }
  // Distance to the scattering, given that there is one, and its density per metre.
  float sample(float u) const;
  float pdf(float t) const;
  // How light arrives at `t`, and what scatters it there.
  Spectrum transmittance_to(float t) const;
  const MediumProperties& medium_at(float t) const { return step_at(t).medium; }
  // Metres that most light comes through.
  float mean_free_path() const;

 private:
  const MediumStep& step_at(float t) const;

  const std::vector<MediumStep>& steps_;
  float length_ = 0.0f;
  bool is_cut_ = false;
  Spectrum transmittance_{1.0f};
  float scatter_probability_ = 0.0f;
};

// Share of the light that crosses `length` metres of `media` along `ray`, which starts `skipped`
// metres after them. Where little is left chance ends the search: the mean is that share.
Spectrum segment_transmittance(const Scene& scene, const MediumStack& media, const Ray& ray,
                               float skipped, float length, const PathInfo& path,
                               ShadingContext& scratch);

}  // namespace tenniel
