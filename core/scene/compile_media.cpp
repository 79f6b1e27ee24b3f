// SPDX-License-Identifier: Apache-2.0
// Which objects are filled, and whether anything is.
#include <algorithm>
#include <utility>

#include "image/volume_io.h"
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

// Least extent of a voxel along an axis of its grid, in metres.
float voxel_extent(const Instance& instance) {
  float least = k_infinity;
  for (const PlacedGrid& grid : instance.grids) {
    const auto& n = grid.voxels->resolution();
    const Transform m = instance.object_to_world * grid.from_object.inverse();
    least =
        std::min({least, length(m.x) / static_cast<float>(n[0]),
                  length(m.y) / static_cast<float>(n[1]), length(m.z) / static_cast<float>(n[2])});
  }
  return least > 0.0f ? least : k_infinity;
}

bool has_values(const GridDesc& desc) {
  if (!desc.values || desc.width < 1 || desc.height < 1 || desc.depth < 1) return false;
  return desc.values->size() == static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) *
                                    static_cast<size_t>(desc.depth) *
                                    static_cast<size_t>(desc.channels);
}

}  // namespace

void SceneCompiler::compile_grids() {
  for (GridDesc& desc : description.grids) {
    SceneGrid& grid = scene.grids.emplace_back();
    if (desc.path.empty()) {
      if (has_values(desc))
        grid.voxels = std::make_unique<const VoxelGrid>(
            *desc.values, std::array{desc.width, desc.height, desc.depth}, desc.channels);
      desc.values.reset();
      continue;
    }
    VolumeLoadResult loaded = load_volume(desc.path, desc.name, cancellation());
    if (!loaded.grid) {
      diagnostics.add({"WARNING", loaded.error, "", "", "", desc.path});
      continue;
    }
    grid.voxels = std::move(loaded.grid);
    grid.from_object = loaded.to_unit;
  }
}

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
      scene.filled_instances.push_back(
          {i, world_bounds(instance, scene.meshes[instance.mesh]), voxel_extent(instance)});
  }
  for (const World& world : scene.worlds)
    note(world.material);
}

}  // namespace tenniel
