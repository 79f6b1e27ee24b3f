// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/numeric.h"

namespace tenniel {

namespace {

template <class T>
size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

size_t mesh_bytes(const Mesh& m) {
  size_t total = bytes(m.positions) + bytes(m.face_vertices) + bytes(m.face_corners) +
                 bytes(m.face_polygons) + bytes(m.face_materials) + bytes(m.face_smooth) +
                 bytes(m.vertex_normals) + bytes(m.corner_normals) + bytes(m.undisplaced) +
                 bytes(m.strands.keys) + bytes(m.strands.segments);
  for (const Attribute& a : m.attributes)
    total += bytes(a.data);
  return total;
}

// A lamp as its tree sees it. Parametric (1 - u - v, u) runs over the rectangle of an area lamp
// and over the directions around a point or spot lamp.
SurfaceInteraction lamp_surface(const Light& light, Vec3 position, Vec3 wi, float distance) {
  SurfaceInteraction at;
  at.position = position;
  at.wo = -wi;
  at.geometric_normal = -wi;
  at.t = std::min(distance, std::numeric_limits<float>::max());
  if (const auto* area = light.as<AreaLight>()) {
    const Vec3 local = position - area->center;
    const float along_u = dot(local, area->dual_u), along_v = dot(local, area->dual_v);
    at.geometric_normal = area->normal;
    at.u = along_v + 0.5f;
    at.v = -along_u - along_v;
  } else if (light.as<SunLight>()) {
    at.position = -wi;
  } else {
    at.u = 0.5f - std::atan2(-wi.x, -wi.y) / k_two_pi;
    at.v = 1.0f - safe_acos(-wi.z) * k_inv_pi;
  }
  at.shading_normal = at.geometric_normal;
  return at;
}

void begin_evaluation(const Scene& scene, const PathInfo& path, ShaderDomain domain, uint8_t query,
                      ShadingContext& context) {
  context.path = path;
  context.domain = domain;
  context.lamp = nullptr;
  context.camera = &scene.camera_info;
  context.begin(query);
}

}  // namespace

size_t Scene::memory_bytes() const {
  size_t total = accel ? accel->memory_bytes() : 0;
  for (const Mesh& mesh : meshes)
    total += mesh_bytes(mesh);
  for (const auto& image : images)
    if (image) total += image->memory_bytes();
  for (const SceneGrid& grid : grids)
    if (grid.voxels) total += grid.voxels->memory_bytes();
  return total;
}

Spectrum background_radiance(const Scene& scene, const World& world, Vec3 direction,
                             const PathInfo& path, ShadingContext& context) {
  const Material& material = world.material;
  if (!material.emits) return {};
  if (material.is_emission_constant) return material.constant_emission;
  context.surface = SurfaceInteraction();
  context.surface.position = direction;
  context.surface.wo = -direction;
  context.surface.geometric_normal = context.surface.shading_normal = -direction;
  begin_evaluation(scene, path, ShaderDomain::world, k_query_emission, context);
  material.emission.run(context);
  return context.emission;
}

void begin_surface(const Scene& scene, const Material& material, const PathInfo& path,
                   uint8_t query, ShadingContext& context) {
  context.material_pass_index = material.pass_index;
  begin_evaluation(scene, path, ShaderDomain::surface, query, context);
}

Spectrum surface_emission(const Scene& scene, const Material& material,
                          const SurfaceInteraction& at, const PathInfo& path,
                          ShadingContext& context) {
  if (!material.emits) return {};
  if (material.is_emission_constant) return material.constant_emission;
  context.surface = at;
  begin_surface(scene, material, path, k_query_emission, context);
  material.emission.run(context);
  return context.emission;
}

Spectrum lamp_emission(const Scene& scene, const Light& light, Vec3 position, Vec3 wi,
                       float distance, const PathInfo& path, ShadingContext& context) {
  if (!light.material) return Spectrum(1.0f);
  const Material& material = *light.material;
  if (material.is_emission_constant) return material.constant_emission;
  context.surface = lamp_surface(light, position, wi, distance);
  begin_evaluation(scene, path, ShaderDomain::lamp, k_query_emission, context);
  context.lamp = &scene.lamp_infos[static_cast<size_t>(&material - scene.lamp_materials.data())];
  material.emission.run(context);
  context.lamp = nullptr;
  return context.emission;
}

}  // namespace tenniel
