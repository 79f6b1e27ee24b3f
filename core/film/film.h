// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "film/pass.h"
#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// What one sample adds to its pixel.
struct FilmSample {
  Spectrum radiance;
  float transparency = 0.0f;  // 1 - alpha
  float depth = 1e10f;        // metres
  Vec3 normal;                // world space
  int dream = 0;              // seen first; 0 = none
  Spectrum dream_radiance;    // part of `radiance`
};

// A rectangle of the film in pixels, y up.
struct FilmRect {
  int x = 0, y = 0, width = 0, height = 0;
};

// Sums of the samples of one pixel. `depth` is that of the first sample, and `dream` that of the
// first that saw one: an average of depths would be a place where nothing is.
struct PixelSums {
  Spectrum radiance;
  float transparency = 0.0f;
  Vec3 normal;
  float depth = 1e10f;
  uint32_t samples = 0;
  uint32_t dream = 0, dream_samples = 0;
  Spectrum dream_radiance;

  void add(const FilmSample& sample) {
    radiance += sample.radiance;
    transparency += sample.transparency;
    normal += sample.normal;
    dream_radiance += sample.dream_radiance;
    if (sample.dream != 0 && dream_samples++ == 0) dream = static_cast<uint32_t>(sample.dream);
    if (samples++ == 0) depth = sample.depth;
  }
};

// A tile of the film, taken out to be added to: its pixels row by row, and `extra` floats for each,
// those of one pixel after those of another.
struct TileSums {
  std::vector<PixelSums> pixels;
  std::vector<float> extra;
};

// Pixels of the picture or of its border. A sample belongs to one pixel, and a tile to one thread
// at a time, so the result does not depend on the number of threads; reading may go on meanwhile.
class Film {
 public:
  static constexpr int k_tile_size = 16;

  // `extra_channels`: floats that each pixel sums besides PixelSums.
  Film(int width, int height, int extra_channels = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  size_t extra_channels() const { return extra_channels_; }
  size_t memory_bytes() const {
    return pixels_.size() * sizeof(PixelSums) + extra_.size() * sizeof(float);
  }

  // All tiles, neighbours close together (Morton order).
  const std::vector<FilmRect>& tiles() const { return tiles_; }
  // The sums of tile `index`; and their replacement by what they grew to.
  TileSums read_tile(size_t index) const;
  void write_tile(size_t index, const TileSums& sums);

  // Averages of one pass over `rect`, bottom row first, channels interleaved; radiance times
  // `exposure`, colour associated with alpha. `rect` lies inside the film.
  void read(const PassInfo& pass, FilmRect rect, float exposure, float* target) const;
  // The same of `channels` extra floats from `first` on, as they are.
  void read_extra(int first, int channels, FilmRect rect, float* target) const;

 private:
  std::mutex& tile_mutex(int x, int y) const;
  // Calls `visit` with the index of each pixel of `rect` in turn, its tile locked.
  template <class Visit>
  void each_pixel(FilmRect rect, const Visit& visit) const;

  int width_, height_;
  int tiles_across_;
  size_t extra_channels_;
  std::vector<PixelSums> pixels_;
  std::vector<float> extra_;
  std::vector<FilmRect> tiles_;
  std::unique_ptr<std::mutex[]> mutexes_;  // by place of the tile, row by row
};

}  // namespace tenniel
