// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "scene/description.h"

// Small scenes in words, for tests of everything above the description.
namespace tenniel::testing {

template <class T>
Buffer<T> buffer(std::vector<T> values) {
  return std::make_shared<std::vector<T>>(std::move(values));
}

// A shader tree that grows node by node; the last output made is 0.
class GraphBuilder {
 public:
  explicit GraphBuilder(std::string name, std::string output = "ShaderNodeOutputMaterial") {
    graph_.name = std::move(name);
    graph_.output = static_cast<int>(add(std::move(output)));
  }
  uint32_t add(std::string type, std::map<std::string, std::vector<float>> inputs = {},
               std::map<std::string, SettingValue> settings = {}) {
    GraphNode& node = graph_.nodes.emplace_back();
    node.name = type + std::to_string(graph_.nodes.size());
    node.type = std::move(type);
    node.inputs = std::move(inputs);
    node.settings = std::move(settings);
    return static_cast<uint32_t>(graph_.nodes.size() - 1);
  }
  GraphBuilder& link(uint32_t from, std::string out, uint32_t to, std::string in) {
    graph_.links.push_back({from, std::move(out), to, std::move(in)});
    return *this;
  }
  GraphBuilder& surface(uint32_t node, std::string out = "BSDF") {
    return link(node, std::move(out), static_cast<uint32_t>(graph_.output), "Surface");
  }
  GraphBuilder& volume(uint32_t node, std::string out = "Volume") {
    return link(node, std::move(out), static_cast<uint32_t>(graph_.output), "Volume");
  }
  NodeGraph build() const { return graph_; }

 private:
  NodeGraph graph_;
};

inline std::vector<float> grey(float value) {
  return {value, value, value, 1.0f};
}

// One closure node linked to the output.
inline NodeGraph single(const std::string& type, std::map<std::string, std::vector<float>> inputs,
                        std::map<std::string, SettingValue> settings = {},
                        const std::string& output_socket = "BSDF") {
  GraphBuilder g(type);
  const uint32_t node = g.add(type, std::move(inputs), std::move(settings));
  return g.surface(node, output_socket).build();
}
inline NodeGraph diffuse(float albedo) {
  return single("ShaderNodeBsdfDiffuse", {{"Color", grey(albedo)}});
}
inline NodeGraph emission(float radiance) {
  return single("ShaderNodeEmission", {{"Color", grey(1.0f)}, {"Strength", {radiance}}}, {},
                "Emission");
}
inline NodeGraph mirror() {
  return single("ShaderNodeBsdfGlossy", {{"Color", grey(1.0f)}, {"Roughness", {0.0f}}},
                {{"distribution", std::string("SHARP")}});
}
inline NodeGraph glossy(float roughness) {
  return single("ShaderNodeBsdfGlossy", {{"Color", grey(1.0f)}, {"Roughness", {roughness}}},
                {{"distribution", std::string("GGX")}});
}
inline NodeGraph glass(float ior) {
  return single("ShaderNodeBsdfGlass",
                {{"Color", grey(1.0f)}, {"Roughness", {0.0f}}, {"IOR", {ior}}},
                {{"distribution", std::string("SHARP")}});
}
// Diffuse light from both sides plus what the surface emits itself.
inline NodeGraph glowing_diffuse(float albedo, float radiance) {
  GraphBuilder g("glowing");
  const uint32_t d = g.add("ShaderNodeBsdfDiffuse", {{"Color", grey(albedo)}});
  const uint32_t e = g.add("ShaderNodeEmission", {{"Color", grey(1.0f)}, {"Strength", {radiance}}});
  const uint32_t sum = g.add("ShaderNodeAddShader");
  g.link(d, "BSDF", sum, "Shader").link(e, "Emission", sum, "Shader_001");
  return g.surface(sum, "Shader").build();
}
// A volume without a surface: one closure node linked to Volume.
inline NodeGraph volume(const std::string& type, std::map<std::string, std::vector<float>> inputs,
                        const std::string& output_socket = "Volume") {
  GraphBuilder g(type);
  const uint32_t node = g.add(type, std::move(inputs));
  return g.volume(node, output_socket).build();
}
inline NodeGraph absorption(float sigma) {
  return volume("ShaderNodeVolumeAbsorption", {{"Color", grey(0.0f)}, {"Density", {sigma}}});
}
inline NodeGraph scatter(float sigma, float g = 0.0f, float albedo = 1.0f) {
  return volume("ShaderNodeVolumePrincipled",
                {{"Color", grey(albedo)}, {"Density", {sigma}}, {"Anisotropy", {g}}});
}
inline NodeGraph background(float radiance) {
  GraphBuilder g("world", "ShaderNodeOutputWorld");
  const uint32_t b =
      g.add("ShaderNodeBackground", {{"Color", grey(1.0f)}, {"Strength", {radiance}}});
  return g.surface(b, "Background").build();
}

// Polygons of any size as Blender would hand them over.
inline MeshDesc mesh_of(const std::vector<std::array<float, 3>>& vertices,
                        const std::vector<std::vector<uint32_t>>& polygons) {
  MeshDesc mesh;
  std::vector<float> positions;
  for (const auto& v : vertices)
    positions.insert(positions.end(), v.begin(), v.end());
  std::vector<uint32_t> corners, triangles;
  std::vector<int32_t> starts, sizes;
  for (const auto& polygon : polygons) {
    const auto first = static_cast<uint32_t>(corners.size());
    starts.push_back(static_cast<int32_t>(first));
    sizes.push_back(static_cast<int32_t>(polygon.size()));
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    for (uint32_t i = 2; i < polygon.size(); ++i)
      for (const uint32_t c : {0u, i - 1, i})
        triangles.push_back(first + c);
  }
  mesh.positions = buffer(std::move(positions));
  mesh.corner_vertices = buffer(std::move(corners));
  mesh.polygon_starts = buffer(std::move(starts));
  mesh.polygon_sizes = buffer(std::move(sizes));
  mesh.triangle_corners = buffer(std::move(triangles));
  return mesh;
}

// Square of side 2 in the xy plane, facing +z.
inline MeshDesc square() {
  return mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}});
}

// Cube of side 2 around the origin, normals outward.
inline MeshDesc box() {
  return mesh_of(
      {{-1, -1, -1},
       {1, -1, -1},
       {1, 1, -1},
       {-1, 1, -1},
       {-1, -1, 1},
       {1, -1, 1},
       {1, 1, 1},
       {-1, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

// Unit sphere of quads and triangles, smooth, normals outward.
inline MeshDesc sphere(int rings = 32, int segments = 64) {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<uint32_t>> polygons;
  const float pi = 3.14159265f;
  for (int r = 0; r <= rings; ++r) {
    const float theta = pi * static_cast<float>(r) / static_cast<float>(rings);
    for (int s = 0; s < segments; ++s) {
      const float phi = 2 * pi * static_cast<float>(s) / static_cast<float>(segments);
      vertices.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  const auto at = [&](int r, int s) { return static_cast<uint32_t>(r * segments + s % segments); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s)
      polygons.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)});
  MeshDesc mesh = mesh_of(vertices, polygons);
  mesh.smooth_flags = buffer(std::vector<uint8_t>(polygons.size(), 1));
  mesh.vertex_normals = mesh.positions;
  return mesh;
}

// A scene that grows: things are added, indices kept inside.
class SceneBuilder {
 public:
  SceneDescription scene;

  SceneBuilder() {
    scene.settings.width = scene.settings.height = 8;
    scene.settings.samples = 64;
    scene.settings.clamp_indirect = 0.0f;
    scene.settings.blur_glossy = 0.0f;
    scene.settings.pixel_filter = "BOX";
    scene.settings.max_bounces = scene.settings.diffuse_bounces = 64;
    scene.settings.glossy_bounces = scene.settings.transmission_bounces = 64;
    scene.settings.transparent_max_bounces = 64;
    scene.settings.volume_bounces = 64;
    world(0.0f);
  }
  // Replaces this side's World.
  SceneBuilder& world(float radiance) {
    scene.worlds.resize(1);
    scene.worlds[0].graph = background(radiance);
    return *this;
  }
  SceneBuilder& dream_world(float radiance) {
    scene.worlds.emplace_back().graph = background(radiance);
    return *this;
  }
  int material(NodeGraph graph) {
    MaterialDesc& m = scene.materials.emplace_back();
    m.name = graph.name;
    m.graph = std::move(graph);
    return static_cast<int>(scene.materials.size()) - 1;
  }
  InstanceDesc& object(MeshDesc mesh, NodeGraph graph, const Matrix34& matrix = k_identity34) {
    scene.meshes.push_back(std::move(mesh));
    const int material_index = material(std::move(graph));
    return instance(static_cast<int>(scene.meshes.size()) - 1, material_index, matrix);
  }
  InstanceDesc& instance(int mesh, int material_index, const Matrix34& matrix) {
    InstanceDesc& i = scene.instances.emplace_back();
    i.name = "object" + std::to_string(scene.instances.size());
    i.mesh = mesh;
    i.materials = {material_index};
    i.object_to_world = matrix;
    return i;
  }
  LightDesc& lamp(const std::string& type, float energy, const Matrix34& matrix) {
    LightDesc& l = scene.lights.emplace_back();
    l.name = type;
    l.type = type;
    l.energy = energy;
    l.object_to_world = matrix;
    return l;
  }
  // Orthographic, looking down -z of `matrix`, `width` metres across.
  SceneBuilder& ortho_camera(const Matrix34& matrix, float width) {
    scene.camera.type = "ORTHO";
    scene.camera.camera_to_world = matrix;
    scene.camera.ortho_scale = width;
    scene.camera.clip_start = 1e-4f;
    return *this;
  }
};

inline Matrix34 at(float x, float y, float z, float scale = 1.0f) {
  return {scale, 0, 0, x, 0, scale, 0, y, 0, 0, scale, z};
}
// Turned about x by `degrees`, then moved.
inline Matrix34 turned(float degrees, float x, float y, float z) {
  const float a = degrees * 3.14159265f / 180.0f, c = std::cos(a), s = std::sin(a);
  return {1, 0, 0, x, 0, c, -s, y, 0, s, c, z};
}

// VisibilityDesc::worlds of the sides of the mirror.
constexpr uint32_t k_behind = 0x1e, k_this_side = 0x01, k_everywhere = 0x1f;

// A glowing panel on each side above a glass in the xy plane, unlike in place and strength, and a
// slanted look at the glass. `sampled`: as lights, else met by chance alone.
inline void light_both_sides(SceneBuilder& b, bool sampled) {
  const auto panel = [&](float radiance, float y, uint32_t worlds) {
    const Matrix34 place{0.5f, 0, 0, 0, 0, 0.5f, 0, y, 0, 0, 0.5f, 1.0f};
    b.object(square(), emission(radiance), place).visibility = {worlds, 0x3e};
    b.scene.materials.back().sample_as_light = sampled;
  };
  panel(2.0f, 0.6f, k_behind);
  panel(5.0f, -0.3f, k_this_side);
  b.ortho_camera(turned(40.0f, 0.0f, -0.8f, 1.0f), 0.3f);
}

}  // namespace tenniel::testing
