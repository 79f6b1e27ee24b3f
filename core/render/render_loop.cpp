// SPDX-License-Identifier: Apache-2.0
#include "render/render_loop.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "film/pixel_filter.h"
#include "integrator/path_integrator.h"
#include "render/flush_denormals.h"
#include "render/light_training.h"
#include "render/sample_group.h"

namespace tenniel {

namespace {

constexpr int k_max_samples_per_visit = 16;
// Paths for each light sample made in advance: with fewer the samples cost as much as they save.
constexpr double k_worthwhile_sharing = 8.0;

PixelFilter filter_of(const RenderSettings& settings) {
  const PixelFilter::Kind kind = settings.pixel_filter == "BOX" ? PixelFilter::Kind::box
                                 : settings.pixel_filter == "GAUSSIAN"
                                     ? PixelFilter::Kind::gaussian
                                     : PixelFilter::Kind::blackman_harris;
  return PixelFilter(kind, settings.filter_width);
}

// Not where the camera or what fills the space before it blurs what two samples would see alike.
bool may_share_camera_rays(const Scene& scene) {
  return !scene.has_motion && !scene.has_media && !(scene.camera.aperture.radius > 0.0f);
}

class RenderLoop {
 public:
  RenderLoop(const Scene& scene, const RenderSettings& settings, Film& film,
             RenderCounters& counters, const std::function<void(size_t)>& on_tile)
      : scene_(scene),
        settings_(settings),
        film_(film),
        counters_(counters),
        on_tile_(on_tile),
        may_share_(may_share_camera_rays(scene)),
        has_edge_(film.tiles().size() * Film::k_tile_size * Film::k_tile_size),
        filter_(filter_of(settings)),
        workers_([&scene, &settings] { return Worker(scene, settings); }) {}

  void run() {
    cache_ = learn_radiance(scene_, settings_, counters_.cancelled);
    const int total = std::max(settings_.samples, 1);
    for (int first = 0, count = 1; first < total && !must_stop();) {
      const int end = std::min(first + count, total);
      prepare_pass(first, end);
      tbb::parallel_for(size_t{0}, film_.tiles().size(), [&](size_t tile) {
        if (!must_stop()) visit(tile, first, end);
      });
      if (must_stop()) return;
      counters_.samples_done = end;
      first = end;
      count = std::min(first, k_max_samples_per_visit);
    }
  }

 private:
  using Results = std::array<SampleResult, k_max_branches>;

  bool must_stop() const {
    if (counters_.cancelled.load(std::memory_order_relaxed)) return true;
    // The first pass always ends, so that there is a picture.
    return settings_.time_limit > 0.0f && counters_.samples_done > 0 &&
           elapsed() > settings_.time_limit;
  }
  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  // Light samples of the Worlds in advance, where many paths are to share them. What is cropped
  // counts as well: a pixel must not know of it.
  void prepare_pass(int first, int end) {
    environments_.reset();
    const double work = static_cast<double>(settings_.width) * settings_.height * (end - first);
    if (work < k_worthwhile_sharing * EnvironmentSamples::k_count) return;
    environments_.emplace(scene_, settings_.seed, number_of(first),
                          [this](int count, const std::function<void(int)>& row) {
                            tbb::parallel_for(0, count, [&](int y) {
                              const FlushDenormals guard;
                              if (!must_stop()) row(y);
                            });
                          });
  }

  // Takes samples [first, end) of every pixel of a tile; one cut short by a cancel is not kept.
  void visit(size_t tile, int first, int end) {
    const FlushDenormals guard;
    Worker& worker = workers_.local();
    worker.environments = environments_ ? &*environments_ : nullptr;
    const FilmRect rect = film_.tiles()[tile];
    TileSums sums = film_.read_tile(tile);
    uint8_t* has_edge = &has_edge_[tile * Film::k_tile_size * Film::k_tile_size];
    Results results;
    uint64_t dropped = 0;
    for (int y = 0; y < rect.height; ++y) {
      for (int x = 0; x < rect.width; ++x) {
        const int index = y * rect.width + x;
        PixelSums& pixel = sums.pixels[static_cast<size_t>(index)];
        float* extra = sums.extra.data() + static_cast<size_t>(index) * film_.extra_channels();
        for (int s = first; s < end;) {
          if (counters_.cancelled.load(std::memory_order_relaxed)) return;
          const SampleGroup group = group_at(s, end, has_edge[index]);
          take(rect.x + x + settings_.border_x, rect.y + y + settings_.border_y, group, worker,
               results);
          for (uint32_t i = 0; i < group.count; ++i)
            dropped += keep(results[i], worker.aov_row(i), pixel, extra) ? 0 : 1;
          if (!results[0].has_forked) has_edge[index] = 1;
          s += static_cast<int>(group.count);
        }
      }
    }
    film_.write_tile(tile, sums);
    counters_.dropped_samples += dropped;
    counters_.pixel_samples_done +=
        static_cast<uint64_t>(rect.width * rect.height) * static_cast<uint64_t>(end - first);
    ++counters_.generation;
    on_tile_(tile);
  }

  SampleGroup group_at(int s, int end, bool has_edge) const {
    return sample_group(number_of(s), number_of(end), may_share_ && !has_edge);
  }
  // Among all samples of the picture, of which this may be a part.
  uint32_t number_of(int s) const { return static_cast<uint32_t>(s + settings_.sample_offset); }

  void take(int x, int y, const SampleGroup& group, Worker& worker, Results& results) const {
    worker.sampler.start_sample(x, y, group.camera_ray);
    const Vec2 u = worker.sampler.get_2d();
    // The first sample looks through the middle of the pixel: what Depth and single samples show.
    const Vec2 offset = group.camera_ray == 0 ? Vec2() : filter_.sample(u);
    const Vec2 raster{static_cast<float>(x) + 0.5f + offset.x,
                      static_cast<float>(y) + 0.5f + offset.y};
    std::fill(worker.aovs.begin(), worker.aovs.end(), 0.0f);
    PathIntegrator(scene_, settings_, cache_.get())
        .trace(raster, group.first, std::span(results).first(group.count), worker);
  }

  // Adds a sample to its pixel. False if a picture cannot hold it.
  static bool keep(const SampleResult& r, std::span<const float> aovs, PixelSums& pixel,
                   float* extra) {
    if (!is_usable(r)) return false;
    pixel.add({r.radiance, r.transparency, r.depth, r.normal, r.dream, r.dream_radiance});
    for (size_t i = 0; i < aovs.size(); ++i)
      if (std::isfinite(aovs[i])) extra[i] += aovs[i];
    return true;
  }

  static bool is_usable(const SampleResult& s) {
    return is_finite(s.radiance) && std::isfinite(s.transparency) && is_finite(s.normal);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  Film& film_;
  RenderCounters& counters_;
  const std::function<void(size_t)>& on_tile_;
  std::unique_ptr<const RadianceCache> cache_;
  std::optional<EnvironmentSamples> environments_;  // of the pass under way
  const bool may_share_;
  // Of each pixel, tile by tile: a sample has met a lamp, the World or nothing where others may see
  // surfaces. Such an edge is the noise of its pixel, and each must look for itself.
  std::vector<uint8_t> has_edge_;
  PixelFilter filter_;
  tbb::enumerable_thread_specific<Worker> workers_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void render_passes(const Scene& scene, const RenderSettings& settings, Film& film,
                   RenderCounters& counters, const std::function<void(size_t tile)>& on_tile) {
  RenderLoop(scene, settings, film, counters, on_tile).run();
}

}  // namespace tenniel
