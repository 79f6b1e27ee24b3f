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

Film::Film(int width, int height, int extra_channels)
    : width_(width),
      height_(height),
      tiles_across_((width + k_tile_size - 1) / k_tile_size),
      extra_channels_(static_cast<size_t>(extra_channels)),
      pixels_(static_cast<size_t>(width) * static_cast<size_t>(height)),
      extra_(pixels_.size() * extra_channels_) {
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

TileSums Film::read_tile(size_t index) const {
  const FilmRect& tile = tiles_[index];
  const auto count = static_cast<size_t>(tile.width) * static_cast<size_t>(tile.height);
  TileSums sums;
  sums.pixels.reserve(count);
  sums.extra.reserve(count * extra_channels_);
  const std::lock_guard lock(tile_mutex(tile.x, tile.y));
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    const ptrdiff_t first = static_cast<ptrdiff_t>(y) * width_ + tile.x;
    const auto row = pixels_.begin() + first;
    sums.pixels.insert(sums.pixels.end(), row, row + tile.width);
    const auto stride = static_cast<ptrdiff_t>(extra_channels_);
    const auto extra = extra_.begin() + first * stride;
    sums.extra.insert(sums.extra.end(), extra, extra + tile.width * stride);
  }
  return sums;
}

void Film::write_tile(size_t index, const TileSums& sums) {
  const FilmRect& tile = tiles_[index];
  const auto stride = static_cast<ptrdiff_t>(extra_channels_);
  const std::lock_guard lock(tile_mutex(tile.x, tile.y));
  for (int y = 0; y < tile.height; ++y) {
    const ptrdiff_t from = static_cast<ptrdiff_t>(y) * tile.width;
    const ptrdiff_t to = static_cast<ptrdiff_t>(tile.y + y) * width_ + tile.x;
    std::copy_n(sums.pixels.begin() + from, tile.width, pixels_.begin() + to);
    std::copy_n(sums.extra.begin() + from * stride, tile.width * stride,
                extra_.begin() + to * stride);
  }
}

template <class Visit>
void Film::each_pixel(FilmRect rect, const Visit& visit) const {
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width;) {
      const int tile_end = std::min((x / k_tile_size + 1) * k_tile_size, rect.x + rect.width);
      const std::lock_guard lock(tile_mutex(x, y));
      for (; x < tile_end; ++x)
        visit(static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x));
    }
  }
}

void Film::read(const PassInfo& pass, FilmRect rect, float exposure, float* target) const {
  each_pixel(rect, [&](size_t pixel) {
    write_pixel(pass, pixels_[pixel], exposure, target);
    target += pass.channels;
  });
}

void Film::read_extra(int first, int channels, FilmRect rect, float* target) const {
  each_pixel(rect, [&](size_t pixel) {
    const uint32_t samples = pixels_[pixel].samples;
    const float scale = samples > 0 ? 1.0f / static_cast<float>(samples) : 0.0f;
    const float* sums = &extra_[pixel * extra_channels_ + static_cast<size_t>(first)];
    for (int c = 0; c < channels; ++c)
      *target++ = sums[c] * scale;
  });
}

}  // namespace tenniel
