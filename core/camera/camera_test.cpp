// SPDX-License-Identifier: Apache-2.0
#include "camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/numeric.h"
#include "sampling/sampler.h"

namespace tenniel {
namespace {

// At (1, 2, 3), looking along +X with +Z up: Blender's camera axes turned.
Camera camera_with(const Lens& lens, int width = 200, int height = 100) {
  Camera c;
  c.camera_to_world = {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, {1, 2, 3}};
  c.world_to_camera = c.camera_to_world.inverse();
  c.lens = lens;
  c.width = width;
  c.height = height;
  return c;
}

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
  EXPECT_NEAR(distance(a, b), 0.0f, tolerance)
      << a.x << " " << a.y << " " << a.z << " / " << b.x << " " << b.y << " " << b.z;
}

void expect_window(const ScreenWindow& w, float left, float right, float bottom, float top) {
  EXPECT_NEAR(w.left, left, 1e-5f);
  EXPECT_NEAR(w.right, right, 1e-5f);
  EXPECT_NEAR(w.bottom, bottom, 1e-5f);
  EXPECT_NEAR(w.top, top, 1e-5f);
}

TEST(PerspectiveWindow, FitsTheSensorAsBlenderDoes) {
  BlenderSensor s;  // 50 mm, 36 x 24
  expect_window(perspective_window(s, 1920, 1080), -0.36f, 0.36f, -0.2025f, 0.2025f);
  // Portrait: the sensor's width goes along the height.
  expect_window(perspective_window(s, 1080, 1920), -0.2025f, 0.2025f, -0.36f, 0.36f);
  expect_window(perspective_window(s, 500, 500), -0.36f, 0.36f, -0.36f, 0.36f);
  s.fit = SensorFit::horizontal;
  expect_window(perspective_window(s, 1080, 1920), -0.36f, 0.36f, -0.64f, 0.64f);
  s.fit = SensorFit::vertical;
  expect_window(perspective_window(s, 1920, 1080), -0.24f * 16 / 9, 0.24f * 16 / 9, -0.24f, 0.24f);
}

TEST(PerspectiveWindow, ShiftsByTheFittedAxis) {
  BlenderSensor s;
  s.shift_x = 0.5f;
  s.shift_y = -0.25f;
  expect_window(perspective_window(s, 200, 100), 0.0f, 0.72f, -0.36f, 0.0f);
  // Vertical fit in portrait: 1 is the height.
  expect_window(perspective_window(s, 100, 200), 0.18f, 0.54f, -0.54f, 0.18f);
}

TEST(PerspectiveWindow, CountsThePixelAspect) {
  BlenderSensor s;
  s.pixel_aspect_x = 2.0f;
  expect_window(perspective_window(s, 100, 100), -0.36f, 0.36f, -0.18f, 0.18f);
  s.pixel_aspect_x = 1.0f;
  s.pixel_aspect_y = 4.0f;
  expect_window(perspective_window(s, 200, 100), -0.18f, 0.18f, -0.36f, 0.36f);
}

TEST(OrthographicWindow, SpansTheScale) {
  BlenderSensor s;
  s.ortho_scale = 6.0f;
  expect_window(orthographic_window(s, 200, 100), -3.0f, 3.0f, -1.5f, 1.5f);
  s.shift_x = 0.1f;
  expect_window(orthographic_window(s, 100, 200), -0.9f, 2.1f, -3.0f, 3.0f);
}

TEST(Camera, CornersOfTheRasterAreCornersOfTheWindow) {
  const Camera c = camera_with(PerspectiveLens{{-0.5f, 0.7f, -0.2f, 0.4f}});
  const auto direction = [&c](float x, float y) { return c.sample_ray({x, y}, {})->ray.direction; };
  // Right is -Y, up is +Z, ahead is +X.
  expect_near(direction(0, 0), normalize(Vec3{1, 0.5f, -0.2f}));
  expect_near(direction(200, 0), normalize(Vec3{1, -0.7f, -0.2f}));
  expect_near(direction(200, 100), normalize(Vec3{1, -0.7f, 0.4f}));
  expect_near(c.sample_ray({0, 0}, {})->ray.origin, {1, 2, 3});
}

TEST(Camera, OrthographicRaysAreParallel) {
  const Camera c = camera_with(OrthographicLens{{-2, 2, -1, 1}});
  const auto ray = c.sample_ray({50, 75}, {})->ray;
  expect_near(ray.direction, {1, 0, 0});
  expect_near(ray.origin, {1, 3, 3.5f});
  const RayCone cone = c.sample_ray({50, 75}, {})->cone;
  EXPECT_FLOAT_EQ(cone.radius, 0.01f);  // half of a pixel of 2 cm
  EXPECT_EQ(cone.spread, 0.0f);
}

TEST(Camera, EquirectangularDirections) {
  const Camera c = camera_with(EquirectangularLens{});
  const auto at = [&c](float u, float v) {
    return c.sample_ray({u * 200.0f, v * 100.0f}, {})->ray.direction;
  };
  expect_near(at(0.5f, 0.5f), {1, 0, 0});    // centre: ahead
  expect_near(at(0.25f, 0.5f), {0, 1, 0});   // a quarter: left
  expect_near(at(0.75f, 0.5f), {0, -1, 0});  // right
  expect_near(at(0.0f, 0.5f), {-1, 0, 0});   // edge: behind
  expect_near(at(0.3f, 1.0f), {0, 0, 1});
  expect_near(at(0.3f, 0.0f), {0, 0, -1});
  expect_near(at(0.5f, 0.75f), normalize(Vec3{1, 0, 1}));
}

TEST(Camera, EquirectangularRangesAreHonoured) {
  // The left upper eighth only.
  const Camera c = camera_with(EquirectangularLens{-k_pi, 0.0f, 0.0f, 0.5f * k_pi});
  expect_near(c.sample_ray({200, 0}, {})->ray.direction, {1, 0, 0});
  expect_near(c.sample_ray({100, 0}, {})->ray.direction, {0, 1, 0});
  expect_near(c.sample_ray({0, 0}, {})->ray.direction, {-1, 0, 0});
}

const Lens k_lenses[] = {PerspectiveLens{{-0.5f, 0.7f, -0.2f, 0.4f}},
                         OrthographicLens{{-2.0f, 3.0f, -1.0f, 1.5f}}, EquirectangularLens{},
                         EquirectangularLens{-2.0f, 1.0f, -0.5f, 1.0f}};

TEST(Camera, WindowInvertsTheRay) {
  LocalRandom random(1);
  for (const Lens& lens : k_lenses) {
    const Camera c = camera_with(lens);
    for (int i = 0; i < 500; ++i) {
      const Vec2 u = random.get_2d();
      const auto ray = c.sample_ray({u.x * 200.0f, u.y * 100.0f}, {})->ray;
      const Vec2 window = c.to_window(ray.at(0.5f + 20.0f * random.get_1d()));
      EXPECT_NEAR(window.x, u.x, 2e-5f) << lens.index();
      EXPECT_NEAR(window.y, u.y, 2e-5f) << lens.index();
    }
  }
}

TEST(Camera, ClipsAlongTheAxis) {
  for (const Lens& lens : k_lenses) {
    for (const float radius : {0.0f, 0.2f}) {
      Camera c = camera_with(lens);
      c.clip_start = 0.5f;
      c.clip_end = 30.0f;
      c.aperture.radius = radius;
      const auto ray = c.sample_ray({13.0f, 80.0f}, {0.9f, 0.3f})->ray;
      const bool is_panorama = std::holds_alternative<EquirectangularLens>(lens);
      if (is_panorama) {
        EXPECT_EQ(ray.t_min, 0.5f);
        EXPECT_EQ(ray.t_max, 30.0f);
      } else {
        EXPECT_NEAR(c.depth(ray.at(ray.t_min)), 0.5f, 1e-5f);
        EXPECT_NEAR(c.depth(ray.at(ray.t_max)), 30.0f, 1e-4f);
      }
    }
  }
}

// Whatever part of the lens a ray leaves, it passes the point in focus of its raster position.
TEST(Camera, RaysMeetInFocus) {
  LocalRandom random(2);
  for (const Lens& lens : k_lenses) {
    Camera c = camera_with(lens);
    const Vec2 raster{150.0f, 20.0f};
    const auto chief = c.sample_ray(raster, {})->ray;
    c.aperture = {0.3f, 4.0f, 6, 0.5f, 2.0f};
    const bool is_panorama = std::holds_alternative<EquirectangularLens>(lens);
    const float along = is_panorama ? 4.0f : 4.0f * chief.t_min / c.clip_start;
    const Vec3 focus = chief.at(along);
    float spread = 0.0f;
    for (int i = 0; i < 200; ++i) {
      const auto ray = c.sample_ray(raster, random.get_2d())->ray;
      expect_near(ray.at(dot(focus - ray.origin, ray.direction)), focus, 2e-5f);
      EXPECT_NEAR(length(ray.direction), 1.0f, 1e-6f);
      spread = std::max(spread, distance(ray.origin, chief.origin));
      EXPECT_LE(distance(ray.origin, chief.origin), 0.3001f);
    }
    EXPECT_GT(spread, 0.2f);
  }
}

// Where on the lens rays start: a disk, a polygon with the middle of a side at `rotation`,
// squeezed.
TEST(Camera, ApertureHasItsShape) {
  Camera c = camera_with(PerspectiveLens{{-1, 1, -1, 1}});
  const auto lens_point = [&c](Vec2 u) {
    const auto ray = c.sample_ray({100, 50}, u)->ray;
    const Vec3 p = c.world_to_camera.point(ray.origin);
    return Vec2{p.x, p.y};
  };
  LocalRandom random(3);
  const float rotation = 0.3f, inner = 0.5f * std::cos(k_pi / 5.0f);
  for (const float ratio : {1.0f, 2.0f}) {
    c.aperture = {0.5f, 10.0f, 5, rotation, ratio};
    float farthest = 0.0f;
    for (int i = 0; i < 5000; ++i) {
      const Vec2 p = lens_point(random.get_2d());
      for (int side = 0; side < 5; ++side) {
        const float angle = rotation + k_two_pi * static_cast<float>(side) / 5.0f;
        const float along = p.x * ratio * std::cos(angle) + p.y * std::sin(angle);
        EXPECT_LE(along, inner + 1e-4f);
        if (side == 0) farthest = std::max(farthest, along);
      }
    }
    EXPECT_GT(farthest, inner * 0.98f);
  }
  c.aperture = {0.5f, 10.0f, 2, 0.0f, 1.0f};
  Vec2 mean;
  for (int i = 0; i < 5000; ++i) {
    const Vec2 p = lens_point(random.get_2d());
    EXPECT_LE(length(p), 0.5001f);
    mean = mean + p * (1.0f / 5000.0f);
  }
  EXPECT_NEAR(length(mean), 0.0f, 0.02f);
}

// The cone is as wide as the distance between the rays of neighbouring pixels.
TEST(Camera, ConeIsHalfAPixelWide) {
  for (const Lens& lens : k_lenses) {
    const Camera c = camera_with(lens);
    for (const Vec2 at : {Vec2{100, 50}, Vec2{3, 90}}) {
      const auto here = *c.sample_ray(at, {});
      const float t = 7.0f;
      const Vec3 p = here.ray.at(t);
      const auto gap = [&](Vec2 step) {
        const Vec3 q = c.sample_ray(at + step * 0.1f, {})->ray.at(t);
        return 10.0f * distance(p, q);
      };
      const float expected = 0.25f * (gap({1, 0}) + gap({0, 1}));
      EXPECT_NEAR(here.cone.radius_at(t) / expected, 1.0f, 0.02f) << lens.index();
    }
  }
}

TEST(Camera, DepthRunsAlongTheAxisOrFromThePoint) {
  const Vec3 p = Vec3{1, 2, 3} + Vec3{3, 4, 0};
  EXPECT_FLOAT_EQ(camera_with(PerspectiveLens{}).depth(p), 3.0f);
  EXPECT_FLOAT_EQ(camera_with(OrthographicLens{}).depth(p), 3.0f);
  EXPECT_FLOAT_EQ(camera_with(EquirectangularLens{}).depth(p), 5.0f);
}

TEST(Camera, WindowOfPointsInTheLensPlaneIsFinite) {
  for (const Lens& lens : k_lenses) {
    const Camera c = camera_with(lens);
    EXPECT_TRUE(is_finite(c.to_window({1, 2, 3})));
    EXPECT_TRUE(is_finite(c.to_window({1, 5, 3})));
  }
}

}  // namespace
}  // namespace tenniel
