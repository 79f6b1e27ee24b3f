// SPDX-License-Identifier: Apache-2.0
#include "integrator/path_integrator.h"

#include <algorithm>
#include <array>
#include <optional>

#include "integrator/path_tracer.h"

namespace tenniel {

namespace {

void aim_aovs(Worker& worker, size_t row) {
  if (worker.aov_floats > 0) worker.surface.aovs = worker.aovs.data() + row * worker.aov_floats;
}

// What the trunk has written is every sample's.
void share_aovs(Worker& worker, size_t rows) {
  for (size_t i = 1; i < rows; ++i)
    std::ranges::copy(worker.aov_row(0), worker.aov_row(i).begin());
}

// All leave the fork before the first goes on to other surfaces, which take its place.
void trace_branches(PathTracer& trunk, uint32_t first, std::span<SampleResult> results,
                    Worker& worker) {
  share_aovs(worker, results.size());
  std::array<std::optional<PathTracer>, k_max_branches> branches;
  for (size_t i = 0; i < results.size(); ++i) {
    worker.sampler.set_index(first + static_cast<uint32_t>(i));
    const bool holds_fork = branches[i].emplace(trunk).leave_fork();
    if (!holds_fork && i + 1 < results.size()) trunk.return_to_fork();
  }
  for (size_t i = 0; i < results.size(); ++i) {
    worker.sampler.set_index(first + static_cast<uint32_t>(i));
    aim_aovs(worker, i);
    branches[i]->follow();
    results[i] = branches[i]->result();
  }
}

}  // namespace

void PathIntegrator::trace(Vec2 raster, uint32_t first, std::span<SampleResult> results,
                           Worker& worker) const {
  PathTracer trunk(scene_, settings_, cache_, worker);
  const bool has_started = trunk.start(raster);
  worker.sampler.set_index(first);
  aim_aovs(worker, 0);
  if (has_started && trunk.reach_fork()) {
    if (results.size() > 1) return trace_branches(trunk, first, results, worker);
    trunk.follow_alone();
  }
  std::fill(results.begin(), results.end(), trunk.result());
  share_aovs(worker, results.size());
}

}  // namespace tenniel
