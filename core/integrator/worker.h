// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "integrator/path_recorder.h"
#include "integrator/segment_media.h"
#include "sampling/sampler.h"
#include "scene/description.h"
#include "scene/scene.h"
#include "shading/shading_context.h"

namespace tenniel {

// What one thread needs of its own to trace paths; made once, so that no sample allocates.
struct Worker {
  Worker(const Scene& scene, const RenderSettings& settings) : sampler(settings.seed) {
    surface.reserve(scene.register_count);
    light.reserve(scene.register_count);
    if (scene.has_media) medium_steps.reserve(k_max_medium_steps);
    if (scene.has_transparent_shadows)
      shadow_hits.resize(static_cast<size_t>(std::max(settings.transparent_max_bounces, 0)));
    surface.rays = light.rays = &scene;
    aovs.resize(static_cast<size_t>(aov_channels(scene.aovs)));
    if (!aovs.empty()) surface.aovs = aovs.data();
  }
  Worker(Worker&&) = default;  // a copy would write into the other's AOVs

  Sampler sampler;
  std::vector<float> aovs;  // of the sample that is traced
  ShadingContext surface;   // the surface the path is at
  ShadingContext light;     // what a light, a shadow caster or the background says meanwhile
  std::vector<MediumStep> medium_steps;  // of the segment the path is on
  std::vector<Hit> shadow_hits;          // of the shadow ray that is traced: all that let it pass
  PathRecorder* recorder = nullptr;      // of a training path
};

}  // namespace tenniel
