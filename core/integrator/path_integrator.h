// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "integrator/radiance_cache.h"
#include "integrator/worker.h"
#include "math/spectrum.h"
#include "math/vec.h"
#include "scene/description.h"
#include "scene/scene.h"

namespace tenniel {

// One sample of one pixel.
struct SampleResult {
  Spectrum radiance;
  float transparency = 0.0f;  // of the film: 1 - alpha
  float depth = 1e10f;        // Blender's value where nothing is hit
  Vec3 normal;                // world space; zero where nothing is hit
  WorldIndex dream = 0;       // seen first, by itself or through mirrors and glass; 0 = none
  Spectrum dream_radiance;    // what of `radiance` came through a looking glass
  bool has_forked = false;    // came to a surface that may send paths different ways
};

// Unidirectional path tracing with next-event estimation. Const; one Worker a thread.
class PathIntegrator {
 public:
  // All must outlive the integrator. `cache`: a guess of the light for the roulette, or null.
  PathIntegrator(const Scene& scene, const RenderSettings& settings,
                 const RadianceCache* cache = nullptr)
      : scene_(scene), settings_(settings), cache_(cache) {}

  // Takes as many samples as `results` has room for (1 to k_max_branches), from number `first` of
  // the pixel on; their AOVs are left in the worker. They leave the camera as one path, which takes
  // its numbers from where the worker's sampler stands (the first belong to the caller), and part
  // at the first surface that may send them different ways: each is a sample as good as any, but
  // they see the same. `raster`: position on the film in pixels, (0, 0) the lower left corner of
  // the whole picture.
  void trace(Vec2 raster, uint32_t first, std::span<SampleResult> results, Worker& worker) const;

  // Dimensions of the sampler that the caller may use before `trace`.
  static constexpr uint32_t k_caller_dimensions = 4;

 private:
  const Scene& scene_;
  const RenderSettings& settings_;
  const RadianceCache* cache_;
};

}  // namespace tenniel
