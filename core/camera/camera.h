// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "math/ray.h"
#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

// Thin-lens aperture; radius 0 = pinhole. `focus_distance` in metres along the view axis (for a
// panorama: along the ray). `ratio` squeezes bokeh horizontally; `blades` < 3 = round.
struct Aperture {
  float radius = 0.0f;
  float focus_distance = 10.0f;
  int blades = 0;
  float rotation = 0.0f;  // radians
  float ratio = 1.0f;
};

// Rectangle on the screen that the picture covers, y up; of a perspective camera on the plane one
// metre ahead (tan(fov/2) included), of an orthographic one in metres.
struct ScreenWindow {
  float left = -1.0f, right = 1.0f, bottom = -1.0f, top = 1.0f;
};

struct PerspectiveLens {
  ScreenWindow window;
};
struct OrthographicLens {
  ScreenWindow window;
};
// Longitudes and latitudes in radians, Blender's defaults.
struct EquirectangularLens {
  float longitude_min = -3.14159265f, longitude_max = 3.14159265f;
  float latitude_min = -1.57079633f, latitude_max = 1.57079633f;
};
using Lens = std::variant<PerspectiveLens, OrthographicLens, EquirectangularLens>;

struct CameraRay {
  Ray ray;
  RayCone cone;  // footprint of one pixel
};

// World-space rays for raster positions. Blender axes: the camera looks along -Z, +Y up.
struct Camera {
  Transform camera_to_world;  // orthonormal: the object's scale is ignored
  Transform world_to_camera;
  std::vector<Transform> motion;  // see `place_at`; empty: it rests
  Lens lens;
  Aperture aperture;
  float clip_start = 0.1f, clip_end = 1000.0f;  // metres along the view axis
  int width = 1, height = 1;                    // of the whole picture in pixels

  // `raster` in pixels, (0, 0) the lower left corner; `lens_u` in [0,1)^2, `time` over the
  // shutter. Empty where the lens has no image (outside a fisheye).
  std::optional<CameraRay> sample_ray(Vec2 raster, Vec2 lens_u, float time = 0.0f) const;
  // World point to [0, 1]^2 of the picture (Texture Coordinate, Window).
  Vec2 to_window(Vec3 world_point) const;
  // What the Depth pass holds: distance along the view axis, or from the camera for a panorama.
  float depth(Vec3 world_point) const;
};

enum class SensorFit : unsigned char { automatic, horizontal, vertical };

// What Blender's camera data says, in its own units, to a window in Blender's conventions.
struct BlenderSensor {
  float lens_mm = 50.0f, sensor_width_mm = 36.0f, sensor_height_mm = 24.0f;
  SensorFit fit = SensorFit::automatic;
  float shift_x = 0.0f, shift_y = 0.0f;
  float ortho_scale = 6.0f;
  float pixel_aspect_x = 1.0f, pixel_aspect_y = 1.0f;
};
ScreenWindow perspective_window(const BlenderSensor& sensor, int width, int height);
ScreenWindow orthographic_window(const BlenderSensor& sensor, int width, int height);

}  // namespace tenniel
