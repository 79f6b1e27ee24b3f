// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "film/film.h"
#include "scene/description.h"
#include "scene/scene.h"

namespace tenniel {

// Shared between the threads that render and whoever watches them.
struct RenderCounters {
  std::atomic<bool> cancelled{false};
  std::atomic<int> samples_done{0};  // finished passes over the whole picture
  std::atomic<uint64_t> pixel_samples_done{0};
  std::atomic<uint64_t> dropped_samples{0};  // not finite
  std::atomic<uint64_t> generation{0};
};

// Takes `settings.samples` samples of every pixel, pass after pass over all tiles: a rough picture
// first, then longer visits that keep a tile's data in cache. Returns when done, cancelled, or at
// the time limit; runs on the TBB arena it is called in. `on_tile` is called by the rendering
// threads after each visit.
void render_passes(const Scene& scene, const RenderSettings& settings, Film& film,
                   RenderCounters& counters, const std::function<void(size_t tile)>& on_tile);

}  // namespace tenniel
