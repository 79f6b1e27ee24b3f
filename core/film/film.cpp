// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <algorithm>

namespace tenniel {

namespace {

// Bits of `x` with a zero between each two.
uint32_t spread_bits(uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

uint32_t morton(const FilmRect& tile) {
  const auto x = static_cast<uint32_t>(tile.x / Film::k_tile_size);
  const auto y = static_cast<uint32_t>(tile.y / Film::k_tile_size);
  return spread_bits(x) | spread_bits(y) << 1;
}

void write_pixel(const PassInfo& pass, const PixelSums& sums, float exposure, float* out) {
  const float scale = sums.samples > 0 ? 1.0f / static_cast<float>(sums.samples) : 0.0f;
  switch (pass.id) {
    case PassId::combined: {
      const Spectrum radiance = sums.radiance * (scale * exposure);
      out[0] = radiance.r;
      out[1] = radiance.g;
      out[2] = radiance.b;
      out[3] = sums.samples > 0 ? std::clamp(1.0f - sums.transparency * scale, 0.0f, 1.0f) : 0.0f;
      break;
    }
    case PassId::depth:
      out[0] = sums.depth;
      break;
    case PassId::normal:
      out[0] = sums.normal.x * scale;
      out[1] = sums.normal.y * scale;
      out[2] = sums.normal.z * scale;
      break;
    case PassId::mirror_world:
      out[0] = static_cast<float>(sums.dream);
      break;
    case PassId::mirror_coverage:
      out[0] = static_cast<float>(sums.dream_samples) * scale;
      break;
    case PassId::dream:
      out[0] = sums.dream_radiance.r * (scale * exposure);
      out[1] = sums.dream_radiance.g * (scale * exposure);
      out[2] = sums.dream_radiance.b * (scale * exposure);
      break;
  }
}

}  // namespace

Film::Film(int width, int height)
    : width_(width),
      height_(height),
      tiles_across_((width + k_tile_size - 1) / k_tile_size),
      pixels_(static_cast<size_t>(width) * static_cast<size_t>(height)) {
  for (int y = 0; y < height; y += k_tile_size)
    for (int x = 0; x < width; x += k_tile_size)
      tiles_.push_back({x, y, std::min(k_tile_size, width - x), std::min(k_tile_size, height - y)});
  mutexes_ = std::make_unique<std::mutex[]>(tiles_.size());
  std::stable_sort(tiles_.begin(), tiles_.end(),
                   [](const FilmRect& a, const FilmRect& b) { return morton(a) < morton(b); });
}

std::mutex& Film::tile_mutex(int x, int y) const {
  const int tile = y / k_tile_size * tiles_across_ + x / k_tile_size;
  return mutexes_[static_cast<size_t>(tile)];
}

std::vector<PixelSums> Film::read_tile(size_t index) const {
  const FilmRect& tile = tiles_[index];
  std::vector<PixelSums> sums;
  sums.reserve(static_cast<size_t>(tile.width) * static_cast<size_t>(tile.height));
  const std::lock_guard lock(tile_mutex(tile.x, tile.y));
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    const auto row = pixels_.begin() + static_cast<ptrdiff_t>(y) * width_ + tile.x;
    sums.insert(sums.end(), row, row + tile.width);
  }
  return sums;
}

void Film::write_tile(size_t index, const std::vector<PixelSums>& sums) {
  const FilmRect& tile = tiles_[index];
  const std::lock_guard lock(tile_mutex(tile.x, tile.y));
  for (int y = 0; y < tile.height; ++y)
    std::copy_n(sums.begin() + static_cast<ptrdiff_t>(y) * tile.width, tile.width,
                pixels_.begin() + static_cast<ptrdiff_t>(tile.y + y) * width_ + tile.x);
}

void Film::read(const PassInfo& pass, FilmRect rect, float exposure, float* target) const {
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width;) {
      const int tile_end = std::min((x / k_tile_size + 1) * k_tile_size, rect.x + rect.width);
      const std::lock_guard lock(tile_mutex(x, y));
      for (; x < tile_end; ++x, target += pass.channels)
        write_pixel(
            pass,
            pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)],
            exposure, target);
    }
  }
}

}  // namespace tenniel
