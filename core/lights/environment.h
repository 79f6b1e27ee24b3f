// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "lights/light_types.h"
#include "sampling/distribution.h"
#include "shading/sun_disk.h"

namespace tenniel {

// Light from everywhere, sampled by an equirectangular map of its radiance. A sun in it is sampled
// apart, by its share of the light.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  // Bakes `radiance` of a unit direction into a width x height map.
  EnvironmentLight(const std::function<Spectrum(Vec3)>& radiance, int width, int height,
                   std::optional<SunDisk> sun = {});

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
  float map_pdf(Vec3 wi) const;
  float sun_pdf(Vec3 wi) const;

  // x: u = 0.5 - atan2(y, x) / 2 pi; y: v = 1 - acos(z) / pi. Shared by copies.
  std::shared_ptr<const Distribution2D> map_;
  float mean_ = 0.0f;
  std::optional<SunDisk> sun_;
  float sun_probability_ = 0.0f;
};

// The direction that the Environment Texture's `equirectangular_projection` maps to `uv`.
Vec3 equirectangular_to_direction(Vec2 uv);

}  // namespace tenniel
