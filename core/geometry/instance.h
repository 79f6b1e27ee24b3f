// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geometry/visibility.h"
#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

class VoxelGrid;

enum class MirrorEntry : uint8_t { reflection, transmission, both };
enum class MirrorReentry : uint8_t { stay, toggle };

// How an object acts as a looking glass; `dream` 0 = it is none.
struct LookingGlass {
  WorldIndex dream = 0;
  MirrorEntry entry = MirrorEntry::reflection;
  MirrorReentry reentry = MirrorReentry::stay;
  bool first_seen_only = false;
};

// Voxels inside an object, by the id of the attribute that they are.
struct PlacedGrid {
  int attribute = -1;
  const VoxelGrid* voxels = nullptr;
  Transform from_object;  // to the unit cube of the grid
  Transform from_world;   // the same where the object rests
};

// One placed mesh: an object, or one instance that an instancer made of it.
struct Instance {
  std::string name;
  uint32_t mesh = 0;                           // index into the scene's meshes
  Transform object_to_world, world_to_object;  // in the middle of the shutter
  std::vector<Transform> motion;               // see `place_at`; empty: it rests
  Visibility visibility;
  LookingGlass looking_glass;
  std::vector<uint32_t> materials;         // per slot, on this side
  std::vector<uint32_t> behind_materials;  // per slot, in the dreams; same size
  Vec3 color{1.0f, 1.0f, 1.0f};            // Object.color
  float alpha = 1.0f;
  float pass_index = 0.0f;
  float random = 0.0f;  // [0, 1] of Object Info
  bool is_holdout = false;
  bool is_searched_alone = false;  // rays below its surface look for it alone
  // Below this cosine shadow rays leave smooth faces from the surface that the normals describe.
  float terminator_cutoff = 0.0f;
  Vec3 generated;  // instancer's generated coordinate and UV, for `from_instancer`
  Vec2 instancer_uv;
  Vec3 texture_space_location;  // Generated = (p - location) / (2 size) + 0.5, object space
  Vec3 texture_space_size{1.0f, 1.0f, 1.0f};
  int light = -1;  // index of its mesh light; -1 = none is sampled
  // Values of `Attribute` nodes of type Object / Instancer / View Layer: 4 floats per id.
  std::vector<std::pair<int, std::array<float, 4>>> object_attributes;
  std::vector<PlacedGrid> grids;      // what fills it
  bool is_void_beyond_grids = false;  // a volume object: where they have no voxels nothing is
  float density_scale = 1.0f;         // of its medium: that of a volume object goes with its size

  Transform object_to_world_at(float time) const {
    return motion.empty() ? object_to_world : place_at(motion, time);
  }
  Transform world_to_object_at(float time) const {
    return motion.empty() ? world_to_object : place_at(motion, time).inverse();
  }

  uint32_t material(int slot, WorldIndex world) const {
    const auto& list = world == 0 ? materials : behind_materials;
    const auto i = static_cast<size_t>(slot);
    return i < list.size() ? list[i] : list.back();
  }
};

}  // namespace tenniel
