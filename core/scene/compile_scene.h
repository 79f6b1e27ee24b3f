// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>

#include "math/cancellation.h"
#include "scene/description.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

namespace tenniel {

struct CompileControl {
  const std::atomic<bool>* cancelled = nullptr;     // polled in whatever may take long
  std::function<void(const char* stage)> on_stage;  // called on the compiling thread
};

// Checks the description and builds what rendering needs. Mendable trouble goes to `diagnostics`
// and a neutral stand-in takes its place; a scene that cannot be rendered throws SceneError.
// Null when cancelled.
std::shared_ptr<const Scene> compile_scene(SceneDescription description, Diagnostics& diagnostics,
                                           const CompileControl& control);

// Steps of a motion during the shutter; none where one of them is not a number.
std::vector<Transform> motion_from(const std::vector<Matrix34>& steps);

// Where each of the passes has its floats.
std::vector<AovPass> layout_aovs(const std::vector<AovDesc>& descriptions);

struct ImageSize {
  int width = 0, height = 0;
};

// Stages of compile_scene, in this order, one file each.
struct SceneCompiler {
  SceneDescription& description;
  Diagnostics& diagnostics;
  const CompileControl& control;
  Scene& scene;
  AttributeIds attributes;
  std::vector<std::vector<std::string>> tangents_of_material;  // UV names, per material
  std::map<int, ImageSize> image_sizes;  // of the images that were loaded, by their index

  void compile_camera();
  void compile_grids();
  void compile_materials();  // also textures
  void compile_geometry();   // meshes, instances, acceleration structure
  void compile_media();      // what is filled
  void compile_lights();     // lamps, mesh lights, environments, light choice
  void compile_environments();
  const EnvironmentLight* equal_environment(WorldIndex w) const;
  ImageSize map_size(WorldIndex w) const;
  EnvironmentLight baked_environment(WorldIndex w) const;
  // 1 where no path can leave this side, else all.
  size_t worlds_in_use() const;
  const WorldDesc& world_desc(WorldIndex w) const;

  bool is_cancelled() const { return control.cancelled && control.cancelled->load(); }
  Cancellation cancellation() const { return Cancellation(control.cancelled); }
};

}  // namespace tenniel
