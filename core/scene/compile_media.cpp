// SPDX-License-Identifier: Apache-2.0
// Which objects are filled, and whether anything is.
#include <algorithm>

#include "scene/compile_scene.h"

namespace tenniel {

namespace {

Bounds3 world_bounds(const Instance& instance, const Mesh& mesh) {
  Bounds3 own, world;
  for (const Vec3 p : mesh.positions)
    own.add(p);
  if (mesh.is_world_space || own.is_empty()) return own;
  for (int corner = 0; corner < 8; ++corner)
    world.add(instance.object_to_world.point({corner & 1 ? own.max.x : own.min.x,
                                              corner & 2 ? own.max.y : own.min.y,
                                              corner & 4 ? own.max.z : own.min.z}));
  return world;
}

}  // namespace

void SceneCompiler::compile_media() {
  const auto note = [&](const Material& material) {
    scene.has_media |= material.has_volume;
    scene.has_emissive_media |=
        material.has_volume &&
        (!material.is_volume_constant || !is_black(material.constant_volume.emission));
  };
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    bool is_filled = false;
    for (const auto* list : {&instance.materials, &instance.behind_materials}) {
      for (const uint32_t m : *list) {
        note(scene.materials[m]);
        is_filled |= scene.materials[m].has_volume;
        scene.has_media |= !scene.materials[m].has_surface;
      }
    }
    if (is_filled)
      scene.filled_instances.push_back({i, world_bounds(instance, scene.meshes[instance.mesh])});
  }
  for (const World& world : scene.worlds)
    note(world.material);
}

}  // namespace tenniel
