// SPDX-License-Identifier: Apache-2.0
#include "render/light_training.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "integrator/path_integrator.h"
#include "render/flush_denormals.h"

namespace tenniel {

namespace {

constexpr uint32_t k_paths = 16384, k_paths_per_task = 512;
constexpr uint32_t k_tasks = k_paths / k_paths_per_task;
// Less work than this many times the training is done without.
constexpr double k_worthwhile_work = 32.0;

std::vector<RadianceRecord> trace_paths(const Scene& scene, const RenderSettings& settings,
                                        uint32_t task, const std::atomic<bool>& cancelled) {
  const FlushDenormals guard;
  std::vector<RadianceRecord> records;
  Worker worker(scene, settings);
  PathRecorder recorder;
  worker.recorder = &recorder;
  const PathIntegrator integrator(scene, settings);
  for (uint32_t i = 0; i < k_paths_per_task && !cancelled; ++i) {
    // A pixel that no picture has.
    const uint32_t index = task * k_paths_per_task + i;
    worker.sampler.start_sample(-1, -1, index);
    const Vec2 u = worker.sampler.get_2d();
    recorder.begin();
    SampleResult sample;
    integrator.trace(
        {u.x * static_cast<float>(settings.width), u.y * static_cast<float>(settings.height)},
        index, {&sample, 1}, worker);
    if (!is_finite(sample.radiance)) continue;
    recorder.finish(sample.radiance,
                    [&](const RadianceRecord& record) { records.push_back(record); });
  }
  return records;
}

}  // namespace

std::unique_ptr<const RadianceCache> learn_radiance(const Scene& scene,
                                                    const RenderSettings& settings,
                                                    const std::atomic<bool>& cancelled) {
  const double work = static_cast<double>(settings.width) * settings.height * settings.samples;
  if (!settings.use_radiance_cache || work < k_worthwhile_work * k_paths) return nullptr;
  std::vector<std::vector<RadianceRecord>> results(k_tasks);
  tbb::parallel_for(0u, k_tasks, [&](uint32_t task) {
    results[task] = trace_paths(scene, settings, task, cancelled);
  });
  if (cancelled) return nullptr;
  std::vector<RadianceRecord> records;
  for (const auto& result : results)
    records.insert(records.end(), result.begin(), result.end());
  return std::make_unique<const RadianceCache>(records);
}

}  // namespace tenniel
