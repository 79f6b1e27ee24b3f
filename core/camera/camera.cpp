// SPDX-License-Identifier: Apache-2.0
#include "camera/camera.h"

#include <algorithm>
#include <cmath>

#include "math/frame.h"
#include "math/numeric.h"
#include "sampling/warp.h"

namespace tenniel {

namespace {

struct PixelSize {
  float x, y;
};

Vec2 at_window(const ScreenWindow& w, float u, float v) {
  return {lerp(w.left, w.right, u), lerp(w.bottom, w.top, v)};
}

Vec2 in_window(const ScreenWindow& w, float x, float y) {
  return {safe_divide(x - w.left, w.right - w.left), safe_divide(y - w.bottom, w.top - w.bottom)};
}

PixelSize pixel_size(const ScreenWindow& w, const Camera& camera) {
  return {std::abs(w.right - w.left) / static_cast<float>(camera.width),
          std::abs(w.top - w.bottom) / static_cast<float>(camera.height)};
}

// Half of the mean extent of a pixel: the radius of the cone that stands for it.
float cone_radius(float extent_x, float extent_y) {
  return 0.25f * (extent_x + extent_y);
}

// A point on the lens, in metres around its centre.
Vec2 sample_aperture(const Aperture& aperture, Vec2 u) {
  Vec2 p;
  if (aperture.blades < 3) {
    p = warp_concentric_disk(u);
  } else {
    // Blender's rotation 0 puts the middle of a side, not a corner, on the x axis.
    const float half_side = k_pi / static_cast<float>(aperture.blades);
    p = warp_regular_polygon(u, aperture.blades, aperture.rotation - half_side);
  }
  return {p.x * aperture.radius / aperture.ratio, p.y * aperture.radius};
}

// A ray in camera space, `t` in metres, before it goes to the world.
struct LocalRay {
  Vec3 origin, direction;
  float t_min, t_max;
  RayCone cone;
};

// From a lens in the plane z = 0 through where `chief` (unit) meets the plane in focus.
LocalRay through_lens(const Camera& camera, Vec3 origin, Vec3 chief, Vec2 lens_u) {
  LocalRay ray{origin, chief, 0.0f, 0.0f, {}};
  if (camera.aperture.radius > 0.0f) {
    const Vec3 focus = origin + chief * (camera.aperture.focus_distance / -chief.z);
    const Vec2 lens = sample_aperture(camera.aperture, lens_u);
    ray.origin += Vec3{lens.x, lens.y, 0.0f};
    ray.direction = normalize(focus - ray.origin);
  }
  // The clip planes are perpendicular to the axis, the origin lies in z = 0.
  ray.t_min = camera.clip_start / -ray.direction.z;
  ray.t_max = camera.clip_end / -ray.direction.z;
  return ray;
}

LocalRay local_ray(const PerspectiveLens& lens, const Camera& camera, Vec2 at, Vec2 lens_u) {
  const Vec2 screen = at_window(lens.window, at.x, at.y);
  const Vec3 chief = normalize({screen.x, screen.y, -1.0f});
  LocalRay ray = through_lens(camera, {}, chief, lens_u);
  // |d direction / d screen| of a normalised direction.
  const PixelSize pixel = pixel_size(lens.window, camera);
  ray.cone.spread = -chief.z * cone_radius(pixel.x * safe_sqrt(1.0f - sqr(chief.x)),
                                           pixel.y * safe_sqrt(1.0f - sqr(chief.y)));
  return ray;
}

LocalRay local_ray(const OrthographicLens& lens, const Camera& camera, Vec2 at, Vec2 lens_u) {
  const Vec2 screen = at_window(lens.window, at.x, at.y);
  LocalRay ray = through_lens(camera, {screen.x, screen.y, 0.0f}, {0.0f, 0.0f, -1.0f}, lens_u);
  const PixelSize pixel = pixel_size(lens.window, camera);
  ray.cone.radius = cone_radius(pixel.x, pixel.y);
  return ray;
}

LocalRay local_ray(const EquirectangularLens& lens, const Camera& camera, Vec2 at, Vec2 lens_u) {
  const float width = lens.longitude_max - lens.longitude_min;
  const float height = lens.latitude_max - lens.latitude_min;
  const float phi = -lens.longitude_min - width * at.x;  // to the left of the view axis
  const float latitude = lens.latitude_min + height * at.y;
  const float horizontal = std::cos(latitude);
  const Vec3 chief{-std::sin(phi) * horizontal, std::sin(latitude), -std::cos(phi) * horizontal};
  LocalRay ray{{}, chief, camera.clip_start, camera.clip_end, {}};
  if (camera.aperture.radius > 0.0f) {
    const Frame frame = Frame::from_normal_tangent(chief, {1.0f, 0.0f, 0.0f});
    const Vec2 on_lens = sample_aperture(camera.aperture, lens_u);
    ray.origin = frame.x * on_lens.x + frame.y * on_lens.y;
    ray.direction = normalize(chief * camera.aperture.focus_distance - ray.origin);
  }
  ray.cone.spread = cone_radius(std::abs(width * horizontal) / static_cast<float>(camera.width),
                                std::abs(height) / static_cast<float>(camera.height));
  return ray;
}

Vec2 window_of(const PerspectiveLens& lens, Vec3 p) {
  return in_window(lens.window, safe_divide(p.x, -p.z), safe_divide(p.y, -p.z));
}

Vec2 window_of(const OrthographicLens& lens, Vec3 p) {
  return in_window(lens.window, p.x, p.y);
}

Vec2 window_of(const EquirectangularLens& lens, Vec3 p) {
  const Vec3 d = normalize_or(p, {0.0f, 0.0f, -1.0f});
  const float phi = std::atan2(-d.x, -d.z);
  const float latitude = std::atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z));
  return {safe_divide(-phi - lens.longitude_min, lens.longitude_max - lens.longitude_min),
          safe_divide(latitude - lens.latitude_min, lens.latitude_max - lens.latitude_min)};
}

// Which axis of the picture the sensor's size goes along, and the other ratios of a fit.
struct Fit {
  bool is_horizontal;
  float size_mm;
  float aspect;  // fitted axis : other axis, pixel aspect included
};

Fit fit_of(const BlenderSensor& sensor, int width, int height) {
  const float x = static_cast<float>(width) * sensor.pixel_aspect_x;
  const float y = static_cast<float>(height) * sensor.pixel_aspect_y;
  const bool is_horizontal =
      sensor.fit == SensorFit::automatic ? x > y : sensor.fit == SensorFit::horizontal;
  // The automatic fit takes the sensor's width in portrait too.
  const float size =
      sensor.fit == SensorFit::vertical ? sensor.sensor_height_mm : sensor.sensor_width_mm;
  return {is_horizontal, size, is_horizontal ? x / y : y / x};
}

// `half` extent of the fitted axis; Blender's shift is in units of that axis' whole extent.
ScreenWindow window_around_shift(const BlenderSensor& sensor, const Fit& fit, float half) {
  const float other = half / fit.aspect;
  const float half_x = fit.is_horizontal ? half : other;
  const float half_y = fit.is_horizontal ? other : half;
  const float x = 2.0f * half * sensor.shift_x, y = 2.0f * half * sensor.shift_y;
  return {x - half_x, x + half_x, y - half_y, y + half_y};
}

}  // namespace

std::optional<CameraRay> Camera::sample_ray(Vec2 raster, Vec2 lens_u, float time) const {
  const Vec2 at{raster.x / static_cast<float>(width), raster.y / static_cast<float>(height)};
  const LocalRay local =
      std::visit([&](const auto& l) { return local_ray(l, *this, at, lens_u); }, lens);
  const Transform place = motion.empty() ? camera_to_world : place_at(motion, time);
  CameraRay result;
  result.ray.origin = place.point(local.origin);
  result.ray.direction = normalize(place.vector(local.direction));
  result.ray.time = time;
  result.ray.t_min = local.t_min;
  result.ray.t_max = local.t_max;
  result.cone = local.cone;
  return result;
}

Vec2 Camera::to_window(Vec3 world_point) const {
  const Vec3 p = world_to_camera.point(world_point);
  return std::visit([p](const auto& l) { return window_of(l, p); }, lens);
}

float Camera::depth(Vec3 world_point) const {
  const Vec3 p = world_to_camera.point(world_point);
  return std::holds_alternative<EquirectangularLens>(lens) ? length(p) : -p.z;
}

ScreenWindow perspective_window(const BlenderSensor& sensor, int width, int height) {
  const Fit fit = fit_of(sensor, width, height);
  return window_around_shift(sensor, fit, fit.size_mm / (2.0f * sensor.lens_mm));
}

ScreenWindow orthographic_window(const BlenderSensor& sensor, int width, int height) {
  return window_around_shift(sensor, fit_of(sensor, width, height), 0.5f * sensor.ortho_scale);
}

}  // namespace tenniel
