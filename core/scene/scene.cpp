// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <type_traits>

namespace tenniel {

namespace {

template <class T>
size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

size_t mesh_bytes(const Mesh& m) {
  size_t total = bytes(m.positions) + bytes(m.face_vertices) + bytes(m.face_corners) +
                 bytes(m.face_polygons) + bytes(m.face_materials) + bytes(m.face_smooth) +
                 bytes(m.vertex_normals) + bytes(m.corner_normals);
  for (const Attribute& a : m.attributes)
    total += bytes(a.data);
  return total;
}

void begin_evaluation(const Scene& scene, const PathInfo& path, ShaderDomain domain,
                      ShadingContext& context) {
  context.path = path;
  context.domain = domain;
  context.camera = &scene.camera_info;
  context.begin(k_query_emission);
}

}  // namespace

size_t Scene::memory_bytes() const {
  size_t total = accel ? accel->memory_bytes() : 0;
  for (const Mesh& mesh : meshes)
    total += mesh_bytes(mesh);
  for (const auto& image : images)
    if (image) total += image->memory_bytes();
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
  begin_evaluation(scene, path, ShaderDomain::world, context);
  material.emission.run(context);
  return context.emission;
}

Spectrum surface_emission(const Scene& scene, const Material& material,
                          const SurfaceInteraction& at, const PathInfo& path,
                          ShadingContext& context) {
  if (!material.emits) return {};
  if (material.is_emission_constant) return material.constant_emission;
  context.surface = at;
  context.material_pass_index = material.pass_index;
  begin_evaluation(scene, path, ShaderDomain::surface, context);
  material.emission.run(context);
  return context.emission;
}

Spectrum lamp_emission(const Scene& scene, const Light& light, Vec3 position, Vec3 wi,
                       float distance, const PathInfo& path, ShadingContext& context) {
  if (!light.material) return Spectrum(1.0f);
  const Material& material = *light.material;
  if (material.is_emission_constant) return material.constant_emission;
  context.surface = SurfaceInteraction();
  context.surface.position = position;
  context.surface.wo = -wi;
  // In a lamp's tree Normal is the direction of emission, and the ray is the one from the lamp.
  context.surface.geometric_normal = context.surface.shading_normal = -wi;
  context.surface.t = distance;
  begin_evaluation(scene, path, ShaderDomain::lamp, context);
  material.emission.run(context);
  return context.emission;
}

}  // namespace tenniel
