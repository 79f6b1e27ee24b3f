// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/path_state.h"
#include "integrator/segment_media.h"
#include "integrator/worker.h"
#include "scene/description.h"

namespace tenniel {

// Next-event estimation for the whole segment that `media` fill around `state.ray`: one distance,
// one light. Takes four requests of the sampler.
Spectrum light_scattered_in(const Scene& scene, const RenderSettings& settings,
                            const PathState& state, const SegmentMedia& media, Worker& worker);

}  // namespace tenniel
