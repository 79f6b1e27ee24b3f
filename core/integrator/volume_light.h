// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/path_state.h"
#include "integrator/worker.h"
#include "media/free_flight.h"
#include "media/medium.h"
#include "scene/description.h"

namespace tenniel {

// Next-event estimation for a whole segment of `state.ray` and of what it skipped, `length` metres
// together: one distance, one light. Takes four requests of the sampler.
Spectrum light_scattered_in(const Scene& scene, const RenderSettings& settings,
                            const PathState& state, const MediumProperties& medium,
                            const FreeFlight& flight, float length, Worker& worker);

}  // namespace tenniel
