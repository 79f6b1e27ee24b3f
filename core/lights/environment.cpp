// SPDX-License-Identifier: Apache-2.0
#include "lights/environment.h"

#include <vector>

#include "math/frame.h"
#include "sampling/warp.h"
#include "shading/nodes/coordinates.h"

namespace tenniel {

Vec3 equirectangular_to_direction(Vec2 uv) {
  const float phi = (0.5f - uv.x) * k_two_pi, theta = (1.0f - uv.y) * k_pi;
  const float sine = std::sin(theta);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
}

namespace {

// Of the half angle, exact for small ones.
float one_minus_cos(const SunDisk& sun) {
  return 2.0f * sqr(std::sin(0.5f * sun.half_angle));
}

bool is_in_sun(const SunDisk& sun, Vec3 direction) {
  return length_squared(direction - sun.direction) <= 2.0f * one_minus_cos(sun);
}

// Mean over the disc, from points spread evenly over its area.
template <class Brightness>
float sun_brightness(const SunDisk& sun, const Brightness& brightness) {
  constexpr int k_side = 6;
  const Frame frame = Frame::from_normal(sun.direction);
  float sum = 0.0f;
  for (int i = 0; i < k_side * k_side; ++i) {
    const int column = i % k_side, row = i / k_side;
    const Vec2 u{(static_cast<float>(column) + 0.5f) / k_side,
                 (static_cast<float>(row) + 0.5f) / k_side};
    sum += brightness(frame.to_world(warp_uniform_cone(u, one_minus_cos(sun))));
  }
  return sum / (k_side * k_side);
}

}  // namespace

EnvironmentLight::EnvironmentLight(const std::function<Spectrum(Vec3)>& radiance, int width,
                                   int height, std::optional<SunDisk> sun)
    : sun_(sun) {
  const auto brightness = [&](Vec3 direction) {
    const float value = mean(radiance(direction));
    return std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
  };
  const auto sample_at = [&](float x, float y) {
    const Vec2 uv{x / static_cast<float>(width), y / static_cast<float>(height)};
    const Vec3 direction = equirectangular_to_direction(uv);
    return sun_ && is_in_sun(*sun_, direction) ? 0.0f : brightness(direction);
  };
  // Centre and corners of each cell: what is bright only between the centres keeps a density.
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  std::vector<float> corners((w + 1) * (h + 1)), values(w * h);
  double sum = 0.0, weight_sum = 0.0;
  for (size_t y = 0; y <= h; ++y)
    for (size_t x = 0; x <= w; ++x)
      corners[y * (w + 1) + x] = sample_at(static_cast<float>(x), static_cast<float>(y));
  for (size_t y = 0; y < h; ++y) {
    const float sine = std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(height) * k_pi);
    for (size_t x = 0; x < w; ++x) {
      const float* c = &corners[y * (w + 1) + x];
      const float center = sample_at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float value = 0.5f * center + 0.125f * (c[0] + c[1] + c[w + 1] + c[w + 2]);
      values[y * w + x] = value * sine;
      sum += static_cast<double>(value) * sine;
      weight_sum += sine;
    }
  }
  map_ = std::make_shared<const Distribution2D>(values, width, height);
  mean_ = static_cast<float>(sum / weight_sum);
  if (!sun_) return;
  const float from_sun = sun_brightness(*sun_, brightness) * one_minus_cos(*sun_) * 0.5f;
  const float share = from_sun > 0.0f ? from_sun / (mean_ + from_sun) : 0.0f;
  // Neither share is exact: a cell of the map may hide something small and bright.
  sun_probability_ = std::clamp(share, 0.1f, 0.9f);
  mean_ += from_sun;
}

std::optional<EnvironmentLight::Direction> EnvironmentLight::sample(Vec2 u) const {
  if (sun_ && u.x < sun_probability_) {
    u.x /= sun_probability_;
    const Vec3 wi =
        Frame::from_normal(sun_->direction).to_world(warp_uniform_cone(u, one_minus_cos(*sun_)));
    // At the rim rounding may have put it outside of what `pdf` calls the sun.
    return Direction{wi, sun_probability_ * uniform_cone_pdf(one_minus_cos(*sun_)) +
                             (1.0f - sun_probability_) * map_pdf(wi)};
  }
  if (sun_)
    u.x = std::min((u.x - sun_probability_) / (1.0f - sun_probability_), k_one_minus_epsilon);
  const Distribution2D::Sample s = map_->sample(u);
  const float sine = std::sin(s.position.y * k_pi);
  if (!(sine > 0.0f) || !(s.pdf > 0.0f)) return {};
  const Vec3 wi = equirectangular_to_direction(s.position);
  const float density = s.pdf / (2.0f * k_pi * k_pi * sine);
  if (!sun_) return Direction{wi, density};
  return Direction{wi, (1.0f - sun_probability_) * density + sun_probability_ * sun_pdf(wi)};
}

float EnvironmentLight::pdf(Vec3 wi) const {
  return (1.0f - sun_probability_) * map_pdf(wi) + sun_probability_ * sun_pdf(wi);
}

float EnvironmentLight::map_pdf(Vec3 wi) const {
  const float sine = safe_sqrt(1.0f - sqr(wi.z));
  if (!(sine > 0.0f)) return 0.0f;
  return map_->pdf(equirectangular_projection(wi)) / (2.0f * k_pi * k_pi * sine);
}

float EnvironmentLight::sun_pdf(Vec3 wi) const {
  return sun_ && is_in_sun(*sun_, wi) ? uniform_cone_pdf(one_minus_cos(*sun_)) : 0.0f;
}

}  // namespace tenniel
