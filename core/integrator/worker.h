// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "integrator/environment_samples.h"
#include "integrator/path_recorder.h"
#include "integrator/segment_media.h"
#include "sampling/sampler.h"
#include "scene/description.h"
#include "scene/scene.h"
#include "shading/shading_context.h"

namespace tenniel {

// Most samples that are traced together.
constexpr uint32_t k_max_branches = 2;

// What one thread needs of its own to trace paths; made once, so that no sample allocates.
struct Worker {
  Worker(const Scene& scene, const RenderSettings& settings) : sampler(settings.seed) {
    surface.reserve(scene.register_count);
    light.reserve(scene.register_count);
    if (scene.has_media) medium_steps.reserve(k_max_medium_steps);
    if (scene.has_transparent_shadows)
      shadow_hits.resize(static_cast<size_t>(std::max(settings.transparent_max_bounces, 0)));
    surface.rays = light.rays = &scene;
    aov_floats = static_cast<size_t>(aov_channels(scene.aovs));
    aovs.resize(aov_floats * k_max_branches);
  }
  Worker(Worker&&) = default;  // a copy would write into the other's AOVs

  // Of the i-th of the samples that are traced together.
  std::span<float> aov_row(size_t i) { return std::span(aovs).subspan(i * aov_floats, aov_floats); }

  Sampler sampler;
  size_t aov_floats = 0;    // of one sample
  std::vector<float> aovs;  // of the samples that are traced together
  ShadingContext surface;   // the surface the path is at
  ShadingContext light;     // what a light, a shadow caster or the background says meanwhile
  std::vector<MediumStep> medium_steps;  // of the segment the path is on
  std::vector<Hit> shadow_hits;          // of the shadow ray that is traced: all that let it pass
  PathRecorder* recorder = nullptr;      // of a training path
  const EnvironmentSamples* environments = nullptr;  // of the pass; null: made as they are needed
};

}  // namespace tenniel
