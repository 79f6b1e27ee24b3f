// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/path_state.h"
#include "integrator/segment_media.h"
#include "integrator/worker.h"
#include "scene/description.h"

namespace tenniel {

// What became of a path between two surfaces.
enum class MediumEvent : uint8_t { passed, scattered, ended };

// The stretch of `state.ray` from its origin to the next surface, `length` metres away, and the
// media that fill it; or from `-state.skipped_before` metres on, as a later part of it. Light that
// the segment itself sends to its start is asked for first, since `advance` moves the path on.
class VolumeWalk {
 public:
  VolumeWalk(const Scene& scene, const RenderSettings& settings, const PathState& state,
             float length, uint32_t part, Worker& worker);

  // Metres of the ray that the walk covers; it goes on from there where that is not all.
  float covered() const { return segment_.length() - skipped_; }
  bool is_cut() const { return segment_.is_cut(); }
  // Nothing is there: the path may go on as if there were no media.
  bool is_vacuum() const { return segment_.is_vacuum(); }
  // What glows on the way.
  Spectrum emission() const { return segment_.emission(); }
  // Light that lamps send into the segment and the media scatter back along it: one sample.
  Spectrum lamp_light(const PathState& state, Worker& worker) const;
  // Scatters the path somewhere on the segment or takes it to its end, with the throughput that is
  // left of it.
  MediumEvent advance(PathState& state, Worker& worker) const;

 private:
  const Scene& scene_;
  const RenderSettings& settings_;
  const uint32_t first_dimension_;
  const float skipped_;
  SegmentMedia segment_;
};

}  // namespace tenniel
