// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lights/light_types.h"
#include "sampling/distribution.h"
#include "shading/sun_disk.h"

namespace tenniel {

// Calls `row` with 0 to count - 1, each once, in whatever order and from whatever threads.
using RowLoop = std::function<void(int count, const std::function<void(int)>& row)>;
void row_after_row(int count, const std::function<void(int)>& row);

// Light from everywhere, sampled by an equirectangular map of its radiance: bilinear between the
// centres of width x height pixels, as what an image of that size shows. A sun in it is sampled
// apart, by its share of the light.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  // Bakes `radiance` of a unit direction; `rows` decides who does what, and changes no bit.
  EnvironmentLight(const std::function<Spectrum(Vec3)>& radiance, int width, int height,
                   std::optional<SunDisk> sun = {}, const RowLoop& rows = row_after_row);

  struct Direction {
    Vec3 wi;
    float pdf = 0.0f;
  };
  std::optional<Direction> sample(Vec2 u) const;
  float pdf(Vec3 wi) const;

  // Whether both aim by the same map, and not by an equal one.
  bool shares_map_with(const EnvironmentLight& other) const { return map_ == other.map_; }
  float mean_radiance() const { return mean_; }

 private:
  // Makes the map of radiance at its corners; the mean over all directions.
  float tabulate(std::vector<float> corners);
  float map_pdf(Vec3 wi) const;
  float sun_pdf(Vec3 wi) const;

  // Over the columns and rows of PixelGrid's cells. Shared by copies.
  std::shared_ptr<const Distribution2D> map_;
  int width_ = 0, height_ = 0;
  float mean_ = 0.0f;
  std::optional<SunDisk> sun_;
  float sun_probability_ = 0.0f;
};

// The direction that the Environment Texture's `equirectangular_projection` maps to `uv`.
Vec3 equirectangular_to_direction(Vec2 uv);

}  // namespace tenniel
