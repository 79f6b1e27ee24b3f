// SPDX-License-Identifier: Apache-2.0
#include "render/session.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

#include "film/film.h"
#include "render/render_loop.h"
#include "scene/compile_scene.h"

namespace tenniel {

namespace {

using Clock = std::chrono::steady_clock;

const PassInfo* find_pass(const std::string& name) {
  for (const PassInfo& pass : k_passes)
    if (pass.name == name) return &pass;
  return nullptr;
}

}  // namespace

struct RenderSession::State {
  // Moved into the scene when the render starts.
  SceneDescription description;
  RenderSettings settings;
  Diagnostics diagnostics;
  RenderCounters counters;
  std::vector<AovPass> aovs;
  Film film;

  mutable std::mutex mutex;  // guards what follows
  std::condition_variable ended_changed;
  std::string stage = "Waiting";
  std::string error;
  bool has_ended = false;
  std::optional<Clock::time_point> render_start, render_end;
  size_t memory_bytes = 0, peak_memory_bytes = 0;
  std::vector<TileRect> finished;
  std::shared_ptr<const Scene> scene;

  std::thread thread;

  State(SceneDescription d, RenderSettings s, int width, int height)
      : description(std::move(d)),
        settings(std::move(s)),
        aovs(layout_aovs(description.aovs)),
        film(width, height, aov_channels(aovs)) {}

  void set_stage(const std::string& name) {
    const std::lock_guard lock(mutex);
    stage = name;
  }
  void note_memory(size_t bytes) {
    const std::lock_guard lock(mutex);
    memory_bytes = bytes + film.memory_bytes();
    peak_memory_bytes = std::max(peak_memory_bytes, memory_bytes);
  }
  void run();
  void compile_and_render();
};

void RenderSession::State::compile_and_render() {
  const CompileControl control{&counters.cancelled, [&](const char* name) { set_stage(name); }};
  std::shared_ptr<const Scene> compiled =
      compile_scene(std::move(description), diagnostics, control);
  if (!compiled) return;
  note_memory(compiled->memory_bytes());
  {
    const std::lock_guard lock(mutex);
    scene = compiled;
    stage = "Rendering";
    render_start = Clock::now();
  }
  render_passes(*compiled, settings, film, counters, [&](size_t tile) {
    const FilmRect& rect = film.tiles()[tile];
    const std::lock_guard lock(mutex);
    finished.push_back({rect.x, rect.y, rect.width, rect.height});
  });
}

void RenderSession::State::run() {
  std::string failure;
  try {
    const int available = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(settings.threads > 0 ? std::min(settings.threads, available) : available);
    arena.execute([&] { compile_and_render(); });
  } catch (const std::bad_alloc&) {
    failure = "Out of memory: the scene does not fit.";
  } catch (const std::exception& e) {
    failure = e.what();
  } catch (...) {
    failure = "The renderer failed for an unknown reason.";
  }
  const std::lock_guard lock(mutex);
  error = failure;
  stage = !failure.empty() ? "Failed" : counters.cancelled ? "Cancelled" : "Done";
  render_end = Clock::now();
  has_ended = true;
  ended_changed.notify_all();
}

RenderSession::RenderSession(SceneDescription description) {
  RenderSettings settings = description.settings;
  settings.width = std::clamp(settings.width, 1, 65536);
  settings.height = std::clamp(settings.height, 1, 65536);
  const bool bordered = settings.border_width > 0 && settings.border_height > 0;
  const int width = bordered ? settings.border_width : settings.width;
  const int height = bordered ? settings.border_height : settings.height;
  if (!bordered) settings.border_x = settings.border_y = 0;
  state_ = std::make_unique<State>(std::move(description), std::move(settings), width, height);
}

RenderSession::~RenderSession() {
  close();
}

void RenderSession::start() {
  if (!state_ || state_->thread.joinable()) return;
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

bool RenderSession::wait(double seconds) {
  if (!state_) return true;
  std::unique_lock lock(state_->mutex);
  const auto limit = std::chrono::duration<double>(std::max(seconds, 0.0));
  return state_->ended_changed.wait_for(lock, limit, [&] { return state_->has_ended; });
}

void RenderSession::cancel() {
  if (state_) state_->counters.cancelled = true;
}

void RenderSession::close() {
  if (!state_) return;
  cancel();
  if (state_->thread.joinable()) state_->thread.join();
  state_.reset();
}

Progress RenderSession::progress() const {
  Progress p;
  if (!state_) {
    p.stage = "Closed";
    return p;
  }
  const RenderCounters& counters = state_->counters;
  p.samples_done = counters.samples_done;
  p.samples_total = std::max(state_->settings.samples, 1);
  p.dropped_samples = counters.dropped_samples;
  p.generation = counters.generation;
  const double wanted = static_cast<double>(state_->film.width()) * state_->film.height() *
                        static_cast<double>(p.samples_total);
  const double fraction = static_cast<double>(counters.pixel_samples_done) / wanted;
  p.fraction = static_cast<float>(fraction);
  const std::lock_guard lock(state_->mutex);
  p.stage = state_->stage;
  p.memory_bytes = state_->memory_bytes;
  p.peak_memory_bytes = state_->peak_memory_bytes;
  if (state_->render_start) {
    const auto now = state_->render_end.value_or(Clock::now());
    p.elapsed = std::chrono::duration<double>(now - *state_->render_start).count();
    if (fraction > 0.0) p.remaining = p.elapsed * (1.0 - fraction) / fraction;
    const double limit = state_->settings.time_limit;
    if (limit > 0.0) {
      const double left = std::max(limit - p.elapsed, 0.0);
      p.remaining = p.remaining < 0.0 ? left : std::min(p.remaining, left);
    }
  }
  if (state_->has_ended) p.remaining = 0.0;
  return p;
}

std::string RenderSession::error() const {
  if (!state_) return {};
  const std::lock_guard lock(state_->mutex);
  return state_->error;
}

std::vector<Diagnostic> RenderSession::take_diagnostics() {
  return state_ ? state_->diagnostics.take() : std::vector<Diagnostic>();
}

std::vector<TileRect> RenderSession::finished_tiles() {
  if (!state_) return {};
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->finished, {});
}

int RenderSession::width() const {
  return state_ ? state_->film.width() : 0;
}
int RenderSession::height() const {
  return state_ ? state_->film.height() : 0;
}

std::vector<std::string> RenderSession::pass_names() const {
  std::vector<std::string> names;
  names.reserve(k_passes.size() + (state_ ? state_->aovs.size() : 0));
  for (const PassInfo& pass : k_passes)
    names.emplace_back(pass.name);
  if (state_)
    for (const AovPass& aov : state_->aovs)
      names.push_back(aov.name);
  return names;
}

size_t RenderSession::pass_size(const std::string& name, TileRect rect) const {
  const PassInfo* pass = find_pass(name);
  const AovPass* aov = pass || !state_ ? nullptr : find_aov(state_->aovs, name);
  const int channels = pass ? pass->channels : aov ? aov->channels() : 0;
  if (rect.width <= 0 || rect.height <= 0) return 0;
  return static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height) *
         static_cast<size_t>(channels);
}

bool RenderSession::read_pass(const std::string& name, TileRect rect, float* target,
                              size_t size) const {
  const bool inside = state_ && rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= width() &&
                      rect.y + rect.height <= height();
  if (!inside || size == 0 || size != pass_size(name, rect)) return false;
  const FilmRect pixels{rect.x, rect.y, rect.width, rect.height};
  if (const PassInfo* pass = find_pass(name)) {
    state_->film.read(*pass, pixels, state_->settings.film_exposure, target);
  } else {
    const AovPass* aov = find_aov(state_->aovs, name);
    state_->film.read_extra(aov->channel, aov->channels(), pixels, target);
  }
  return true;
}

}  // namespace tenniel
