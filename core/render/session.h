// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene/description.h"
#include "scene/diagnostics.h"

namespace tenniel {

struct Progress {
  std::string stage;     // what is being done, for the artist
  int samples_done = 0;  // finished passes over the whole picture
  int samples_total = 0;
  float fraction = 0.0f;    // [0, 1] of all pixel samples
  double elapsed = 0.0;     // seconds since the first ray
  double remaining = -1.0;  // seconds, an estimate; -1 while unknown
  size_t memory_bytes = 0;  // scene and film
  size_t peak_memory_bytes = 0;
  uint64_t dropped_samples = 0;  // not finite
  uint64_t generation = 0;       // rises whenever there are new pixels
};

// A rectangle of the bordered picture in pixels, y up.
struct TileRect {
  int x = 0, y = 0, width = 0, height = 0;
};

// Compiles and renders one picture on native threads of its own, sample after sample over all
// tiles. Every method may be called from any one thread while it renders; none calls back.
class RenderSession {
 public:
  explicit RenderSession(SceneDescription description);
  ~RenderSession();  // cancels and joins
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;

  void start();  // once; later calls do nothing
  // Blocks until the render has ended or `seconds` are over; true when it has ended.
  bool wait(double seconds);
  void cancel();  // at once; the threads stop within a sample
  void close();   // cancels, joins, frees scene and film

  Progress progress() const;
  std::string error() const;  // why the render failed; empty if it did not
  std::vector<Diagnostic> take_diagnostics();
  std::vector<TileRect> finished_tiles();  // since the last call

  int width() const;  // of the picture or of its border
  int height() const;
  std::vector<std::string> pass_names() const;  // the film's own and the scene's AOVs
  // Floats that `read_pass` writes for a rectangle; 0 for an unknown pass.
  size_t pass_size(const std::string& name, TileRect rect) const;
  // Copies `rect` of a pass, bottom row first, channels interleaved, averaged over the samples
  // taken. False when the pass is unknown, the rectangle is not inside, or `size` is not
  // pass_size().
  bool read_pass(const std::string& name, TileRect rect, float* target, size_t size) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tenniel
