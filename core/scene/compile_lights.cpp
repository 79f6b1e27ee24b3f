// SPDX-License-Identifier: Apache-2.0
// Lamps in Blender 3.4's units to radiance, and emissive meshes to lights.
#include <algorithm>
#include <cmath>

#include "scene/compile_scene.h"

namespace tenniel {

namespace {

// Radiant flux P in watts -> intensity P / (4 pi) of a point, spread over the disk pi r^2 that
// every receiver sees: radiance P / (4 pi^2 r^2).
PointLight point_light(const LightDesc& desc, Spectrum power, Vec3 position) {
  PointLight light{position, std::max(desc.radius, 0.0f), power / (4.0f * k_pi)};
  if (light.radius > 0.0f) light.radiance = light.radiance / light.area();
  return light;
}

SpotLight spot_light(const LightDesc& desc, Spectrum power, const Transform& matrix) {
  return {point_light(desc, power, matrix.translation),
          normalize_or(-matrix.z, {0.0f, 0.0f, -1.0f}),
          std::cos(0.5f * std::clamp(desc.spot_size, 0.0f, k_pi)), saturate(desc.spot_blend)};
}

// Power over four times the area, until Blender 3.6: P / (4 A).
AreaLight area_light(const LightDesc& desc, Spectrum power, const Transform& matrix) {
  AreaLight light;
  const bool symmetric = desc.shape == "SQUARE" || desc.shape == "DISK";
  light.set_place(matrix.translation, matrix.x * desc.size_x,
                  matrix.y * (symmetric ? desc.size_x : desc.size_y),
                  normalize_or(-matrix.z, {0.0f, 0.0f, -1.0f}));
  light.is_ellipse = desc.shape == "DISK" || desc.shape == "ELLIPSE";
  const float area = light.area();
  light.radiance = area > 0.0f ? power / (4.0f * area) : Spectrum();
  light.set_spread(desc.spread);
  return light;
}

SunLight sun_light(const LightDesc& desc, Spectrum irradiance, const Transform& matrix) {
  return {normalize_or(matrix.z, {0.0f, 0.0f, 1.0f}),
          std::tan(0.5f * std::clamp(desc.angle, 0.0f, k_pi - 1e-3f)), irradiance};
}

LightShape lamp_shape(const LightDesc& desc, Spectrum power, const Transform& matrix) {
  if (desc.type == "SPOT") return spot_light(desc, power, matrix);
  if (desc.type == "AREA") return area_light(desc, power, matrix);
  if (desc.type == "SUN") return sun_light(desc, power, matrix);
  return point_light(desc, power, matrix.translation);
}

bool has_extent(const LightShape& shape) {
  const auto* area = std::get_if<AreaLight>(&shape);
  return !area || area->area() > 0.0f;
}

// Mean radiance that light sampling may expect of a material, from its folded program or, where
// that varies over the surface, from a few points of it.
float expected_emission(const Scene& scene, const Instance& instance, const Material& material,
                        size_t slot, ShadingContext& context) {
  if (!material.emits || !material.sample_as_light) return 0.0f;
  if (material.is_emission_constant) return std::max(mean(material.constant_emission), 0.0f);
  const Mesh& mesh = scene.meshes[instance.mesh];
  constexpr size_t k_probes = 64;
  const size_t step = std::max<size_t>(1, mesh.face_count() / k_probes);
  double sum = 0.0;
  int count = 0;
  for (size_t face = 0; face < mesh.face_count(); face += step) {
    const auto f = static_cast<uint32_t>(face);
    if (static_cast<size_t>(mesh.material_slot(f)) != slot) continue;
    const FaceTriangle t = face_triangle(mesh, f, false);
    Vec3 p[3];
    for (size_t i = 0; i < 3; ++i) {
      p[i] = mesh.positions[t.vertices[i]];
      if (!mesh.is_world_space) p[i] = instance.object_to_world.point(p[i]);
    }
    const Vec3 normal = normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0.0f, 0.0f, 1.0f});
    const Vec3 center = (p[0] + p[1] + p[2]) / 3.0f;
    const Ray ray{center + normal, -normal};
    const Hit hit{1.0f, 1.0f / 3.0f, 1.0f / 3.0f, f, scene.index_of(instance)};
    PathInfo path;
    path.kind = RayKind::diffuse;
    path.ray_depth = 1;
    const Spectrum emitted =
        surface_emission(scene, material, scene.interaction(ray, hit, 0.0f), path, context);
    if (is_finite(emitted)) sum += std::max(mean(emitted), 0.0f);
    ++count;
  }
  // A small floor: what no probe met may still shine.
  return count > 0 ? std::max(static_cast<float>(sum / count), 1e-3f) : 0.0f;
}

}  // namespace

void SceneCompiler::compile_lights() {
  ShadingContext context;
  context.reserve(scene.register_count);
  auto& lights = scene.lights;

  for (size_t i = 0; i < description.lights.size(); ++i) {
    const LightDesc& desc = description.lights[i];
    const Spectrum power = Spectrum(desc.color[0], desc.color[1], desc.color[2]) * desc.energy;
    const Transform matrix = Transform::from_rows(desc.object_to_world);
    if (!is_finite(power) || !is_finite(matrix)) {
      diagnostics.add({"WARNING",
                       "The lamp's power, colour or position is not a number: it is off.",
                       desc.name, "", "", ""});
      continue;
    }
    Light light;
    light.name = desc.name;
    light.shape = lamp_shape(desc, power, matrix);
    light.visibility = Visibility::from_sets(desc.visibility.worlds, desc.visibility.ray_kinds);
    light.casts_shadow = desc.casts_shadow;
    light.use_mis = desc.use_mis;
    light.max_bounces = desc.max_bounces;
    if (!desc.graph.nodes.empty()) light.material = &scene.lamp_materials[i];
    if (!is_black(power) && has_extent(light.shape)) lights.push_back(std::move(light));
  }

  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    Instance& instance = scene.instances[i];
    // What moves is met by chance: the places where it could be sampled belong to one time only.
    if (!instance.motion.empty()) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    std::vector<float> emission(instance.materials.size(), 0.0f);
    for (size_t slot = 0; slot < emission.size(); ++slot)
      for (const auto* list : {&instance.materials, &instance.behind_materials})
        if (slot < list->size())
          emission[slot] = std::max(
              emission[slot],
              expected_emission(scene, instance, scene.materials[(*list)[slot]], slot, context));
    if (*std::max_element(emission.begin(), emission.end()) == 0.0f) continue;
    MeshLight shape(instance, i, mesh, emission);
    if (shape.empty()) continue;
    Light light;
    light.name = instance.name;
    light.visibility = instance.visibility;
    light.shape = std::move(shape);
    instance.light = static_cast<int>(lights.size());
    lights.push_back(std::move(light));
  }

  compile_environments();
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (is_hittable(lights[i])) scene.hittable_lamps.push_back(i);
  for (WorldIndex w = 0; w < k_world_count; ++w)
    scene.light_samplers[w] = LightSampler(lights, w);
}

}  // namespace tenniel
