// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "geometry/accel.h"
#include "geometry/instance.h"
#include "geometry/mesh.h"
#include "image/texture.h"
#include "image/voxel_grid.h"
#include "lights/light.h"
#include "lights/light_sampler.h"
#include "math/bounds.h"
#include "shading/material.h"
#include "shading/ray_queries.h"

namespace tenniel {

// The background of one world.
struct World {
  Material material;
  Visibility visibility;
  int light = -1;                    // index of its EnvironmentLight; -1 = black, or not sampled
  bool radiance_knows_path = false;  // it may differ between paths that see the same direction
};

// An object that a material with a Volume fills, in one world at least.
struct FilledInstance {
  uint32_t instance = 0;
  Bounds3 bounds;            // world space
  float voxel = k_infinity;  // metres: least extent of its grids' voxels
};

struct SceneGrid {
  std::unique_ptr<const VoxelGrid> voxels;  // null: unusable
  std::optional<Transform> from_object;     // to its unit cube; none: by the texture space
};

// Everything a render reads: made by `compile_scene`, immutable since, shared by all threads.
struct Scene final : RayQueries {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;  // the last one is Blender's default material
  std::vector<std::unique_ptr<const Texture>> textures;
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<SceneGrid> grids;  // as in the description
  std::vector<Material> lamp_materials;
  std::vector<LampInfo> lamp_infos;  // of lamp_materials, index by index
  std::shared_ptr<const Accel> accel;
  std::vector<FilledInstance> filled_instances;
  std::vector<Light> lights;
  std::vector<uint32_t> hittable_lamps;  // indices of lights that rays can meet
  std::array<LightSampler, k_world_count> light_samplers;
  std::array<World, k_world_count> worlds;
  std::vector<AovPass> aovs;
  Camera camera;
  CameraInfo camera_info;
  bool has_transparent_shadows = false;
  bool has_emissive_surfaces = false;
  bool has_looking_glasses = false;
  bool has_motion = false;  // something moves while the shutter is open
  bool has_media = false;   // or boundaries of such; else no ray looks for any
  bool has_emissive_media = false;
  size_t register_count = 0;  // the most any program needs

  const Material& material_at(const SurfaceInteraction& at, WorldIndex world) const {
    return materials[at.instance->material(at.mesh->material_slot(at.face), world)];
  }
  const Material& material_at(const Hit& hit, WorldIndex world) const {
    const Instance& instance = instances[hit.instance];
    return materials[instance.material(meshes[instance.mesh].material_slot(hit.face), world)];
  }
  uint32_t index_of(const Instance& instance) const {
    return static_cast<uint32_t>(&instance - instances.data());
  }
  // Calls what `interaction` reads first from memory.
  void prefetch(const Hit& hit) const { meshes[instances[hit.instance].mesh].prefetch(hit.face); }
  // World-space point and normals where `ray` met `hit`.
  SurfaceInteraction interaction(const Ray& ray, const Hit& hit, float footprint) const {
    const Instance& instance = instances[hit.instance];
    return make_interaction(ray, hit, instance, meshes[instance.mesh], footprint);
  }
  bool is_free(const SurfaceInteraction& from, Vec3 direction, float distance, WorldIndex world,
               bool own_only) const override;
  size_t own_hits(const SurfaceInteraction& from, const Ray& ray,
                  std::span<OwnHit> hits) const override;
  // Bytes of meshes, textures and the acceleration structure.
  size_t memory_bytes() const;
};

// Radiance of a World seen along `direction`; `context` is scratch.
Spectrum background_radiance(const Scene& scene, const World& world, Vec3 direction,
                             const PathInfo& path, ShadingContext& context);
// Prepares `context`, whose surface is set, for the programs of that surface's material.
void begin_surface(const Scene& scene, const Material& material, const PathInfo& path,
                   uint8_t query, ShadingContext& context);
// What the surface at `at` emits toward at.wo; `context` is scratch.
Spectrum surface_emission(const Scene& scene, const Material& material,
                          const SurfaceInteraction& at, const PathInfo& path,
                          ShadingContext& context);
// Factor that a lamp's node tree puts on its radiance, `wi` from the shading point to the lamp.
Spectrum lamp_emission(const Scene& scene, const Light& light, Vec3 position, Vec3 wi,
                       float distance, const PathInfo& path, ShadingContext& context);

}  // namespace tenniel
