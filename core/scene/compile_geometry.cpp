// SPDX-License-Identifier: Apache-2.0
// Meshes and instances, ready for rays.
#include <tbb/parallel_for.h>

#include <set>

#include "geometry/connectivity.h"
#include "geometry/pointiness.h"
#include "geometry/vertex_normals.h"
#include "math/hash.h"
#include "scene/compile_scene.h"
#include "scene/displace.h"
#include "shading/nodes/attribute_names.h"

namespace tenniel {

namespace {

template <class T>
const T* data_or_null(const Buffer<T>& buffer, size_t size) {
  return buffer && buffer->size() >= size ? buffer->data() : nullptr;
}

StrandSoup strand_soup(const MeshDesc& desc) {
  StrandSoup soup;
  soup.name = desc.name;
  soup.shape = desc.shape == "SPHERES" ? Shape::spheres
               : desc.shape == "TUBES" ? Shape::tubes
                                       : Shape::ribbons;
  const size_t keys = desc.positions ? desc.positions->size() / 3 : 0;
  soup.positions = data_or_null(desc.positions, 0);
  soup.radii = data_or_null(desc.radii, keys);
  soup.key_count = keys;
  soup.sizes = data_or_null(desc.strand_sizes, 0);
  soup.strand_count = desc.strand_sizes ? desc.strand_sizes->size() : 0;
  soup.to_object = Transform::from_rows(desc.to_object);
  soup.ribbon_pieces = desc.ribbon_pieces;
  return soup;
}

Mesh strands_from(const MeshDesc& desc) {
  StrandSoup soup = strand_soup(desc);
  std::vector<float> radii;
  if (soup.radii == nullptr) {
    radii = tapered_radii(soup,
                          {desc.root_radius, desc.tip_radius, desc.radius_shape, desc.closes_tip});
    soup.radii = radii.data();
  }
  return build_strands(soup);
}

PolygonSoup polygon_soup(const MeshDesc& desc) {
  PolygonSoup soup;
  soup.name = desc.name;
  const auto size_of = [](const auto& buffer) { return buffer ? buffer->size() : size_t{0}; };
  soup.vertex_count = size_of(desc.positions) / 3;
  soup.corner_count = size_of(desc.corner_vertices);
  soup.polygon_count = std::min(size_of(desc.polygon_starts), size_of(desc.polygon_sizes));
  soup.triangle_count = size_of(desc.triangle_corners) / 3;
  soup.positions = data_or_null(desc.positions, 0);
  soup.corner_vertices = data_or_null(desc.corner_vertices, 0);
  soup.polygon_starts = data_or_null(desc.polygon_starts, 0);
  soup.polygon_sizes = data_or_null(desc.polygon_sizes, 0);
  soup.triangle_corners = data_or_null(desc.triangle_corners, 0);
  soup.material_indices = data_or_null(desc.material_indices, soup.polygon_count);
  soup.smooth_flags = data_or_null(desc.smooth_flags, soup.polygon_count);
  soup.vertex_normals = data_or_null(desc.vertex_normals, soup.vertex_count * 3);
  soup.corner_normals = data_or_null(desc.corner_normals, soup.corner_count * 3);
  return soup;
}

Mesh mesh_from(const MeshDesc& desc, const Cancellation& cancellation) {
  return desc.shape == "FACES" ? build_mesh(polygon_soup(desc), cancellation) : strands_from(desc);
}

size_t element_count(const MeshDesc& desc, AttributeDomain domain) {
  switch (domain) {
    case AttributeDomain::vertex:
      return desc.positions ? desc.positions->size() / 3 : 0;
    case AttributeDomain::corner:
      return desc.corner_vertices ? desc.corner_vertices->size() : 0;
    case AttributeDomain::face:
      if (desc.shape == "SPHERES") return element_count(desc, AttributeDomain::vertex);
      if (desc.shape != "FACES") return desc.strand_sizes ? desc.strand_sizes->size() : 0;
      return desc.polygon_starts ? desc.polygon_starts->size() : 0;
  }
  return 0;
}

// Meshes keep no edges: what lies on them goes to the vertices.
void move_edge_values(MeshDesc& desc) {
  for (AttributeDesc& a : desc.attributes) {
    if (a.domain != "EDGE" || !a.data || !desc.edge_vertices) continue;
    a.domain = "POINT";
    a.data = std::make_shared<std::vector<float>>(edges_to_vertices(
        desc.positions->size() / 3, *desc.edge_vertices, *a.data, static_cast<size_t>(a.channels)));
  }
}

void add_islands(Mesh& mesh, const MeshDesc& desc, const AttributeIds& ids) {
  if (!desc.edge_vertices || ids.find(k_random_per_island) == AttributeIds::k_none) return;
  const auto parts = connected_parts(mesh.positions.size(), *desc.edge_vertices);
  std::vector<float> values(element_count(desc, AttributeDomain::face), 0.0f);
  for (size_t polygon = 0; polygon < values.size(); ++polygon) {
    const auto corner = static_cast<size_t>((*desc.polygon_starts)[polygon]);
    if (corner >= desc.corner_vertices->size()) continue;
    const uint32_t vertex = (*desc.corner_vertices)[corner];
    if (vertex < parts.size()) values[polygon] = uint_to_unit_closed(hash_uint(parts[vertex]));
  }
  mesh.attributes.push_back({k_random_per_island, AttributeDomain::face, 1, std::move(values)});
}

// What Hair Info and Point Info tell apart.
void add_strand_values(Mesh& mesh, const MeshDesc& desc, const AttributeIds& ids) {
  const auto add = [&](const char* name, AttributeDomain domain, std::vector<float> values) {
    if (ids.find(name) != AttributeIds::k_none)
      mesh.attributes.push_back({name, domain, 1, std::move(values)});
  };
  if (mesh.shape == Shape::faces) return;
  std::vector<float> numbers(element_count(desc, AttributeDomain::face));
  for (size_t i = 0; i < numbers.size(); ++i)
    numbers[i] =
        uint_to_unit_closed(hash_uint(static_cast<uint32_t>(desc.first_strand + int(i)), 0));
  add(k_strand_random, AttributeDomain::face, std::move(numbers));
  if (mesh.shape == Shape::spheres) return;
  StrandLengths lengths = measure_strands(strand_soup(desc));
  add(k_strand_intercept, AttributeDomain::vertex, std::move(lengths.intercepts));
  add(k_strand_length, AttributeDomain::face, std::move(lengths.lengths));
}

void add_pointiness(Mesh& mesh, const MeshDesc& desc, const AttributeIds& ids,
                    const Cancellation& cancellation) {
  if (!desc.edge_vertices || ids.find(k_pointiness) == AttributeIds::k_none) return;
  mesh.attributes.push_back(
      {k_pointiness, AttributeDomain::vertex, 1,
       pointiness(mesh.positions, vertex_normals(polygon_soup(desc), cancellation),
                  *desc.edge_vertices, cancellation)});
}

// Keeps the attributes that some program asks for.
void add_attributes(Mesh& mesh, MeshDesc& desc, const AttributeIds& ids, Diagnostics& diagnostics) {
  for (AttributeDesc& a : desc.attributes) {
    if (!a.data || ids.find(a.name) == AttributeIds::k_none) continue;
    if (desc.shape != "FACES" && a.domain != "POINT" && a.domain != "FACE") continue;
    const AttributeDomain domain = a.domain == "POINT"  ? AttributeDomain::vertex
                                   : a.domain == "FACE" ? AttributeDomain::face
                                                        : AttributeDomain::corner;
    if (a.data->size() < element_count(desc, domain) * static_cast<size_t>(a.channels)) {
      diagnostics.add({"WARNING", "Attribute '" + a.name + "' has too few values and is left out.",
                       desc.name, "", "", ""});
      continue;
    }
    mesh.attributes.push_back({a.name, domain, static_cast<uint8_t>(a.channels),
                               a.data.use_count() == 1 ? std::move(*a.data) : *a.data});
  }
}

void index_attributes(Mesh& mesh, const AttributeIds& ids) {
  mesh.slot_of_attribute.assign(static_cast<size_t>(ids.count()), -1);
  for (size_t i = 0; i < mesh.attributes.size(); ++i) {
    const int id = ids.find(mesh.attributes[i].name);
    if (id != AttributeIds::k_none)
      mesh.slot_of_attribute[static_cast<size_t>(id)] = static_cast<int16_t>(i);
  }
}

void make_tangents(Mesh& mesh, const std::set<std::string>& uv_names,
                   const Cancellation& cancellation) {
  for (const std::string& uv_name : uv_names) {
    for (size_t i = 0; i < mesh.attributes.size(); ++i) {
      if (mesh.attributes[i].name != uv_name || mesh.attributes[i].channels != 2) continue;
      const Attribute uv = mesh.attributes[i];  // a copy: the list grows under it
      add_tangents(mesh, uv, uv_name + ".tangent", cancellation);
      break;
    }
  }
}

LookingGlass looking_glass_from(const LookingGlassDesc& desc) {
  LookingGlass glass;
  glass.dream = static_cast<WorldIndex>(std::clamp(desc.dream, 0, k_world_count - 1));
  glass.entry = desc.entry == "TRANSMISSION" ? MirrorEntry::transmission
                : desc.entry == "BOTH"       ? MirrorEntry::both
                                             : MirrorEntry::reflection;
  glass.reentry = desc.reentry == "TOGGLE" ? MirrorReentry::toggle : MirrorReentry::stay;
  glass.first_seen_only = desc.first_seen_only;
  return glass;
}

std::vector<uint32_t> material_list(const std::vector<int>& indices, size_t count) {
  const auto fallback = static_cast<uint32_t>(count - 1);
  std::vector<uint32_t> list;
  list.reserve(indices.size());
  for (const int i : indices)
    list.push_back(i >= 0 && static_cast<size_t>(i) < count ? static_cast<uint32_t>(i) : fallback);
  if (list.empty()) list.push_back(fallback);
  return list;
}

// By which a diagonal grows, as Cycles measures volume objects; 1 where nothing is left of it.
float mean_scale(const Transform& transform) {
  const float scale = length(transform.vector(normalize(Vec3{1.0f, 1.0f, 1.0f})));
  return scale > 0.0f ? scale : 1.0f;
}

Instance instance_from(const InstanceDesc& desc, const MeshDesc& mesh, size_t material_count,
                       const AttributeIds& ids) {
  Instance instance;
  instance.name = desc.name;
  instance.mesh = static_cast<uint32_t>(desc.mesh);
  instance.object_to_world = Transform::from_rows(desc.object_to_world);
  instance.world_to_object = instance.object_to_world.inverse();
  instance.motion = motion_from(desc.motion);
  instance.visibility = Visibility::from_sets(desc.visibility.worlds, desc.visibility.ray_kinds);
  instance.looking_glass = looking_glass_from(desc.looking_glass);
  instance.materials = material_list(desc.materials, material_count);
  instance.behind_materials = desc.behind_materials.empty()
                                  ? instance.materials
                                  : material_list(desc.behind_materials, material_count);
  instance.color = {desc.color[0], desc.color[1], desc.color[2]};
  instance.alpha = desc.color[3];
  instance.pass_index = desc.pass_index;
  instance.random = desc.random;
  instance.is_holdout = desc.is_holdout;
  instance.terminator_cutoff = desc.terminator_cutoff;
  if (desc.has_scaled_density) instance.density_scale = 1.0f / mean_scale(instance.object_to_world);
  instance.generated = {desc.generated[0], desc.generated[1], desc.generated[2]};
  instance.instancer_uv = {desc.instancer_uv[0], desc.instancer_uv[1]};
  const auto& location = mesh.texture_space_location;
  const auto& size = mesh.texture_space_size;
  instance.texture_space_location = {location[0], location[1], location[2]};
  instance.texture_space_size = {size[0], size[1], size[2]};
  for (const auto& [name, value] : desc.attributes)
    if (const int id = ids.find(name); id != AttributeIds::k_none)
      instance.object_attributes.emplace_back(id, value);
  return instance;
}

// From object space to Generated coordinates; empty where an extent is 0, as in Cycles.
Transform texture_space(const Instance& instance) {
  const Vec3 size = instance.texture_space_size * 2.0f, at = instance.texture_space_location;
  const Vec3 s{safe_divide(1.0f, size.x), safe_divide(1.0f, size.y), safe_divide(1.0f, size.z)};
  return {{s.x, 0.0f, 0.0f},
          {0.0f, s.y, 0.0f},
          {0.0f, 0.0f, s.z},
          {0.5f - at.x * s.x, 0.5f - at.y * s.y, 0.5f - at.z * s.z}};
}

void add_grids(Instance& instance, const InstanceDesc& desc, const SceneCompiler& compiler) {
  for (const int index : desc.grids) {
    const auto i = static_cast<size_t>(index);
    if (index < 0 || i >= compiler.scene.grids.size()) continue;
    const SceneGrid& grid = compiler.scene.grids[i];
    const int id = compiler.attributes.find(compiler.description.grids[i].name);
    if (!grid.voxels || id == AttributeIds::k_none) continue;
    const Transform from_object = grid.from_object.value_or(texture_space(instance));
    instance.grids.push_back(
        {id, grid.voxels.get(), from_object, from_object * instance.world_to_object});
    instance.is_void_beyond_grids = grid.from_object.has_value();
  }
}

bool can_place(const InstanceDesc& desc, size_t mesh_count, Diagnostics& diagnostics) {
  if (desc.mesh < 0 || static_cast<size_t>(desc.mesh) >= mesh_count) return false;
  if (is_finite(Transform::from_rows(desc.object_to_world))) return true;
  diagnostics.add({"WARNING",
                   "The object's position, rotation or scale is not a number: it is left out.",
                   desc.name, "", "", ""});
  return false;
}

}  // namespace

void SceneCompiler::compile_geometry() {
  auto& meshes = description.meshes;
  auto& instances = description.instances;
  std::erase_if(instances,
                [&](const InstanceDesc& i) { return !can_place(i, meshes.size(), diagnostics); });
  std::vector<int> users(meshes.size(), 0);
  std::vector<size_t> first_user(meshes.size(), 0);
  std::vector<std::set<std::string>> tangents(meshes.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    const InstanceDesc& desc = instances[i];
    const auto mesh = static_cast<size_t>(desc.mesh);
    if (users[mesh]++ == 0) first_user[mesh] = i;
    scene.instances.push_back(
        instance_from(desc, meshes[mesh], scene.materials.size(), attributes));
    add_grids(scene.instances.back(), desc, *this);
    for (const auto* list : {&desc.materials, &desc.behind_materials})
      for (const int m : *list)
        if (m >= 0 && static_cast<size_t>(m) < tangents_of_material.size())
          tangents[mesh].insert(tangents_of_material[static_cast<size_t>(m)].begin(),
                                tangents_of_material[static_cast<size_t>(m)].end());
  }

  scene.meshes.resize(meshes.size());
  tbb::parallel_for(size_t{0}, meshes.size(), [&](size_t i) {
    if (is_cancelled() || users[i] == 0) return;
    Mesh& mesh = scene.meshes[i];
    mesh = mesh_from(meshes[i], cancellation());
    move_edge_values(meshes[i]);
    add_attributes(mesh, meshes[i], attributes, diagnostics);
    add_islands(mesh, meshes[i], attributes);
    add_strand_values(mesh, meshes[i], attributes);
    add_pointiness(mesh, meshes[i], attributes, cancellation());
    make_tangents(mesh, tangents[i], cancellation());
    index_attributes(mesh, attributes);
    if (mesh.dropped_faces > 0)
      diagnostics.add({"WARNING",
                       std::to_string(mesh.dropped_faces) +
                           (mesh.shape == Shape::faces ? " faces" : " pieces of hair or points") +
                           " are broken (not finite, or without vertices) and left out.",
                       meshes[i].name, "", "", ""});
    meshes[i] = MeshDesc();
    const Instance& user = scene.instances[first_user[i]];
    const bool has_faces = mesh.shape == Shape::faces;
    if (has_faces) displace(scene, user, mesh, diagnostics, cancellation());
    // A mesh that only one instance uses joins the top level of the acceleration structure.
    if (users[i] == 1 && user.motion.empty() && user.object_to_world.determinant() != 0.0f &&
        (has_faces || keeps_shape(user.object_to_world)))
      move_to_world_space(mesh, user.object_to_world);
  });
  if (is_cancelled()) return;

  for (Instance& instance : scene.instances) {
    if (instance.looking_glass.dream > 0) scene.has_looking_glasses = true;
    if (!instance.motion.empty()) scene.has_motion = true;
    for (const auto* list : {&instance.materials, &instance.behind_materials}) {
      for (const uint32_t m : *list) {
        const Material& material = scene.materials[m];
        instance.is_searched_alone |= material.has_subsurface;
        scene.has_emissive_surfaces |= material.emits;
        scene.has_transparent_shadows |= material.is_transparent && material.use_transparent_shadow;
      }
    }
  }
  static const std::atomic<bool> never{false};
  scene.accel =
      Accel::build(scene.meshes, scene.instances, control.cancelled ? *control.cancelled : never);
}

}  // namespace tenniel
