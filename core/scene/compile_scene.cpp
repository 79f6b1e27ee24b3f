// SPDX-License-Identifier: Apache-2.0
#include "scene/compile_scene.h"

#include <algorithm>
#include <cmath>

namespace tenniel {

namespace {

SensorFit sensor_fit(const std::string& name) {
  return name == "HORIZONTAL" ? SensorFit::horizontal
         : name == "VERTICAL" ? SensorFit::vertical
                              : SensorFit::automatic;
}

// Rotation and place of a camera: Blender ignores its scale.
Transform without_scale(const Transform& t) {
  const Vec3 z = normalize_or(t.z, {0.0f, 0.0f, 1.0f});
  const Vec3 y = normalize_or(t.y, {0.0f, 1.0f, 0.0f});
  const Vec3 x = normalize_or(t.x, {1.0f, 0.0f, 0.0f});
  return {x, y, z, t.translation};
}

Vec2 window_of(const void* camera, Vec3 world_point) {
  return static_cast<const Camera*>(camera)->to_window(world_point);
}

}  // namespace

std::vector<Transform> motion_from(const std::vector<Matrix34>& steps) {
  constexpr size_t k_max_steps = 129;
  std::vector<Transform> motion;
  motion.reserve(steps.size());
  for (const Matrix34& step : steps)
    motion.push_back(Transform::from_rows(step));
  const auto finite = [](const Transform& t) { return is_finite(t); };
  const bool is_usable = motion.size() > 1 && motion.size() <= k_max_steps &&
                         std::all_of(motion.begin(), motion.end(), finite);
  return is_usable ? motion : std::vector<Transform>();
}

size_t SceneCompiler::worlds_in_use() const {
  const auto is_glass = [](const InstanceDesc& i) { return i.looking_glass.dream > 0; };
  const bool leaves =
      description.settings.start_world > 0 ||
      std::any_of(description.instances.begin(), description.instances.end(), is_glass);
  return leaves ? k_world_count : 1;
}

void SceneCompiler::compile_camera() {
  const CameraDesc& desc = description.camera;
  const RenderSettings& settings = description.settings;
  const Transform matrix = Transform::from_rows(desc.camera_to_world);
  if (!is_finite(matrix)) throw SceneError("The camera's position or rotation is not a number.");
  Camera& camera = scene.camera;
  camera.camera_to_world = without_scale(matrix);
  camera.world_to_camera = camera.camera_to_world.inverse();
  for (const Transform& step : motion_from(desc.motion))
    camera.motion.push_back(without_scale(step));
  if (!camera.motion.empty()) scene.has_motion = true;
  camera.width = std::max(settings.width, 1);
  camera.height = std::max(settings.height, 1);
  camera.clip_start = std::max(desc.clip_start, 1e-6f);
  camera.clip_end = desc.clip_end;
  if (!(camera.clip_end > camera.clip_start)) {
    diagnostics.add({"WARNING",
                     "The camera's clip end lies before its clip start: nothing is clipped.",
                     "Camera", "", "", ""});
    camera.clip_end = k_infinity;
  }
  camera.aperture = {std::max(desc.aperture_radius, 0.0f), std::max(desc.focus_distance, 1e-5f),
                     desc.aperture_blades, desc.aperture_rotation,
                     std::max(desc.aperture_ratio, 1e-3f)};
  const BlenderSensor sensor{
      desc.lens,          desc.sensor_width, desc.sensor_height, sensor_fit(desc.sensor_fit),
      desc.shift_x,       desc.shift_y,      desc.ortho_scale,   desc.pixel_aspect_x,
      desc.pixel_aspect_y};
  if (desc.type == "PANO") {
    camera.lens = EquirectangularLens{desc.longitude_min, desc.longitude_max, desc.latitude_min,
                                      desc.latitude_max};
  } else if (desc.type == "ORTHO") {
    camera.lens = OrthographicLens{orthographic_window(sensor, camera.width, camera.height)};
  } else {
    camera.lens = PerspectiveLens{perspective_window(sensor, camera.width, camera.height)};
  }
  scene.camera_info = {camera.world_to_camera, &window_of, &camera};
}

std::shared_ptr<const Scene> compile_scene(SceneDescription description, Diagnostics& diagnostics,
                                           const CompileControl& control) {
  auto scene = std::make_shared<Scene>();
  scene->occlusion_distance = description.settings.occlusion_distance;
  SceneCompiler compiler{description, diagnostics, control, *scene, {}, {}, {}};
  const auto stage = [&](const char* name, void (SceneCompiler::*run)()) {
    if (compiler.is_cancelled()) return;
    if (control.on_stage) control.on_stage(name);
    (compiler.*run)();
  };
  try {
    stage("Camera", &SceneCompiler::compile_camera);
    stage("Grids", &SceneCompiler::compile_grids);
    stage("Compiling shaders", &SceneCompiler::compile_materials);
    stage("Building BVH", &SceneCompiler::compile_geometry);
    stage("Volumes", &SceneCompiler::compile_media);
    stage("Lights", &SceneCompiler::compile_lights);
  } catch (const Cancelled&) {
    return nullptr;
  }
  if (compiler.is_cancelled()) return nullptr;
  return scene;
}

}  // namespace tenniel
