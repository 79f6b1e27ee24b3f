// SPDX-License-Identifier: Apache-2.0
#include "lights/environment.h"

#include <numeric>
#include <utility>
#include <vector>

#include "math/frame.h"
#include "sampling/warp.h"
#include "shading/nodes/coordinates.h"

namespace tenniel {

Vec3 equirectangular_to_direction(Vec2 uv) {
  const CosSin around = cos_sin_of_turns(0.5f - uv.x), down = cos_sin_of_turns(0.5f - 0.5f * uv.y);
  return {down.sin * around.cos, down.sin * around.sin, down.cos};
}

namespace {

// Of the half angle, exact for small ones.
float one_minus_cos(const SunDisk& sun) {
  return 2.0f * sqr(std::sin(0.5f * sun.half_angle));
}

bool is_in_sun(const SunDisk& sun, Vec3 direction) {
  return length_squared(direction - sun.direction) <= 2.0f * one_minus_cos(sun);
}

// `direction`, or what lies beside the sun at its side: the sky there goes on behind the sun.
Vec3 beside_sun(const SunDisk& sun, Vec3 direction) {
  if (!is_in_sun(sun, direction)) return direction;
  const Frame frame = Frame::from_normal(sun.direction);
  const Vec3 local = frame.to_local(direction);
  const Vec3 side = normalize_or({local.x, local.y, 0.0f}, {1.0f, 0.0f, 0.0f});
  const float angle = 1.05f * sun.half_angle;
  return frame.to_world({std::sin(angle) * side.x, std::sin(angle) * side.y, std::cos(angle)});
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

// What is darker than the mean is left to the sampling of surfaces, which finds it as well (Karlik
// et al. 2019, "MIS Compensation"); this share of it stays, for what no surface samples.
constexpr float k_dim_share = 0.03f;

// Cells between the centres of width x height pixels: one begins at each pixel of a row, the last
// of which ends at the first pixel again, and the lowest and highest row, half as high, end at the
// poles. Their corners are `width + 1` x `height + 2`.
struct PixelGrid {
  int width, height;

  int rows() const { return height + 1; }
  size_t stride() const { return static_cast<size_t>(width) + 1; }
  size_t corner_count() const { return stride() * (static_cast<size_t>(height) + 2); }
  // The image coordinates at a place of the unit square over the cells, and back.
  Vec2 to_uv(Vec2 p) const {
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    const float u = p.x + 0.5f / w, y = p.y * (h + 1.0f);
    const float v = y < 1.0f ? 0.5f * y : y > h ? h - 0.5f * (h + 1.0f - y) : y - 0.5f;
    return {u < 1.0f ? u : u - 1.0f, v / h};
  }
  Vec2 from_uv(Vec2 uv) const {
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    const float x = uv.x - 0.5f / w, v = uv.y * h;
    const float y = v < 0.5f ? 2.0f * v : v > h - 0.5f ? h + 1.0f - 2.0f * (h - v) : v + 0.5f;
    return {x < 0.0f ? x + 1.0f : x, y / (h + 1.0f)};
  }
  // How much of the unit square a part of the image at height v takes.
  float stretch(float v) const {
    const auto h = static_cast<float>(height);
    const bool is_pole = v * h < 0.5f || v * h > h - 0.5f;
    return (is_pole ? 2.0f : 1.0f) * h / (h + 1.0f);
  }
  // Density per solid angle of one over the unit square, at `wi` and its height `v` of the image; 0
  // at the poles. From the sides of `wi`: 1 - z * z has few digits left where it is small.
  float per_solid_angle(Vec3 wi, float v) const {
    const float sine = std::sqrt(sqr(wi.x) + sqr(wi.y));
    return sine > 0.0f ? stretch(v) / (2.0f * k_pi * k_pi * sine) : 0.0f;
  }
  float sine_of_row(int y) const {
    return std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(height) * k_pi);
  }
};

}  // namespace

void row_after_row(int count, const std::function<void(int)>& row) {
  for (int y = 0; y < count; ++y)
    row(y);
}

EnvironmentLight::EnvironmentLight(const std::function<Spectrum(Vec3)>& radiance, int width,
                                   int height, std::optional<SunDisk> sun, const RowLoop& rows)
    : width_(width), height_(height), sun_(sun) {
  const auto brightness = [&](Vec3 direction) {
    const float value = mean(radiance(direction));
    return std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
  };
  const PixelGrid grid{width, height};
  std::vector<float> corners(grid.corner_count(), 0.0f);
  rows(height, [&](int y) {
    float* row = &corners[grid.stride() * (static_cast<size_t>(y) + 1)];
    for (int x = 0; x < width; ++x) {
      const Vec3 direction = equirectangular_to_direction(
          {(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
           (static_cast<float>(y) + 0.5f) / static_cast<float>(height)});
      row[x] = brightness(sun_ ? beside_sun(*sun_, direction) : direction);
    }
    row[width] = row[0];
  });
  mean_ = tabulate(std::move(corners));
  if (!sun_) return;
  const float from_sun = sun_brightness(*sun_, brightness) * one_minus_cos(*sun_) * 0.5f;
  const float share = from_sun > 0.0f ? from_sun / (mean_ + from_sun) : 0.0f;
  // Neither share is exact: a cell of the map may hide something small and bright.
  sun_probability_ = std::clamp(share, 0.1f, 0.9f);
  mean_ += from_sun;
}

float EnvironmentLight::tabulate(std::vector<float> corners) {
  const PixelGrid grid{width_, height_};
  double sum = 0.0, weight_sum = 0.0;
  const auto row_at = [&](int y) { return &corners[grid.stride() * (static_cast<size_t>(y) + 1)]; };
  for (int y = 0; y < height_; ++y) {
    const double sine = grid.sine_of_row(y);
    sum += sine * std::accumulate(row_at(y), row_at(y) + width_, 0.0);
    weight_sum += sine * width_;
  }
  const auto average = static_cast<float>(sum / weight_sum);
  for (int y = 0; y < height_; ++y) {
    const float sine = grid.sine_of_row(y);
    for (float* value = row_at(y); value <= row_at(y) + width_; ++value)
      *value = std::max(*value - average, k_dim_share * *value) * sine;
  }
  map_ = std::make_shared<const Distribution2D>(std::move(corners), width_, grid.rows());
  return average;
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
  const PixelGrid grid{width_, height_};
  const Vec2 uv = grid.to_uv(s.position);
  const Vec3 wi = equirectangular_to_direction(uv);
  const float density = s.pdf * grid.per_solid_angle(wi, uv.y);
  if (!(density > 0.0f)) return {};
  if (!sun_) return Direction{wi, density};
  return Direction{wi, (1.0f - sun_probability_) * density + sun_probability_ * sun_pdf(wi)};
}

float EnvironmentLight::pdf(Vec3 wi) const {
  return (1.0f - sun_probability_) * map_pdf(wi) + sun_probability_ * sun_pdf(wi);
}

float EnvironmentLight::map_pdf(Vec3 wi) const {
  const PixelGrid grid{width_, height_};
  const Vec2 uv = equirectangular_projection(wi);
  return map_->pdf(grid.from_uv(uv)) * grid.per_solid_angle(wi, uv.y);
}

float EnvironmentLight::sun_pdf(Vec3 wi) const {
  return sun_ && is_in_sun(*sun_, wi) ? uniform_cone_pdf(one_minus_cos(*sun_)) : 0.0f;
}

}  // namespace tenniel
