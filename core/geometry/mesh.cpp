// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/vertex_normals.h"

namespace tenniel {

namespace {

// Embree ignores primitives that reach farther; beyond, squared distances leave the float range.
constexpr float k_farthest = 1e18f;

bool is_usable(Vec3 p) {
  return std::abs(p.x) < k_farthest && std::abs(p.y) < k_farthest && std::abs(p.z) < k_farthest;
}

std::vector<Vec3> to_vec3(const float* data, size_t count) {
  std::vector<Vec3> result;
  result.reserve(count + 1);  // Embree reads 16 bytes of the last vertex
  for (size_t i = 0; i < count; ++i)
    result.push_back({data[3 * i], data[3 * i + 1], data[3 * i + 2]});
  return result;
}

// A vector with the same value everywhere says no more than that value.
template <class T>
bool is_uniform(const std::vector<T>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

bool has_smooth_faces(const PolygonSoup& soup) {
  const uint8_t* flags = soup.smooth_flags;
  return flags != nullptr &&
         std::any_of(flags, flags + soup.polygon_count, [](uint8_t flag) { return flag != 0; });
}

size_t triangle_count(int polygon_size) {
  return polygon_size < 3 ? 0 : static_cast<size_t>(polygon_size) - 2;
}

// Turns the polygons of a soup into the faces of a mesh.
class FaceBuilder {
 public:
  FaceBuilder(const PolygonSoup& soup, Mesh& mesh, const Cancellation& cancellation)
      : soup_(soup), mesh_(mesh), cancellation_(cancellation) {
    usable_vertices_.resize(soup.vertex_count);
    for (size_t i = 0; i < soup.vertex_count; ++i)
      usable_vertices_[i] = is_usable(mesh.positions[i]);
  }

  void run() {
    mesh_.corners_per_face = keeps_quads() ? 4 : 3;
    const size_t faces = soup_.polygon_count;
    mesh_.face_vertices.reserve(faces * static_cast<size_t>(mesh_.corners_per_face));
    mesh_.face_corners.reserve(faces * static_cast<size_t>(mesh_.corners_per_face));
    mesh_.face_polygons.reserve(faces);
    size_t first_triangle = 0;
    for (size_t polygon = 0; polygon < soup_.polygon_count; ++polygon) {
      cancellation_.check();
      const int size = soup_.polygon_sizes[polygon];
      if (!is_valid(polygon)) {
        ++mesh_.dropped_faces;
      } else {
        add_polygon(polygon, first_triangle);
      }
      first_triangle += triangle_count(size);
    }
    drop_redundant_arrays();
  }

 private:
  // A quad takes 106 bytes in Embree, a triangle 81: two for a quad without quads, the room of a
  // quad for every triangle with them.
  bool keeps_quads() const {
    double as_quads = 0.0, as_triangles = 0.0;
    for (size_t i = 0; i < soup_.polygon_count; ++i) {
      cancellation_.check();
      if (!is_valid(i)) continue;
      const int size = soup_.polygon_sizes[i];
      const auto triangles = static_cast<double>(triangle_count(size));
      as_triangles += 81.0 * triangles;
      as_quads += 106.0 * (size == 4 ? 1.0 : triangles);
    }
    return as_quads < as_triangles;
  }

  // In range and long enough; its vertices are looked at face by face.
  bool is_valid(size_t polygon) const {
    const int64_t start = soup_.polygon_starts[polygon], size = soup_.polygon_sizes[polygon];
    return start >= 0 && size >= 3 && start + size <= static_cast<int64_t>(soup_.corner_count);
  }

  // Blender's own triangle of a polygon; false where its corners are not the polygon's.
  bool blender_triangle(size_t polygon, size_t triangle, uint32_t (&corners)[3]) const {
    if (triangle >= soup_.triangle_count || soup_.triangle_corners == nullptr) return false;
    const auto start = static_cast<uint32_t>(soup_.polygon_starts[polygon]);
    const auto size = static_cast<uint32_t>(soup_.polygon_sizes[polygon]);
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = soup_.triangle_corners[3 * triangle + i];
      if (corners[i] - start >= size) return false;  // wraps below the start
    }
    return true;
  }

  void add_polygon(size_t polygon, size_t first_triangle) {
    const auto start = static_cast<uint32_t>(soup_.polygon_starts[polygon]);
    const int size = soup_.polygon_sizes[polygon];
    if (size == 4 && mesh_.corners_per_face == 4) {
      const uint32_t turn = splits_along_0_2(polygon, first_triangle) ? 1 : 0;
      const uint32_t corners[4] = {start + turn, start + turn + 1, start + turn + 2,
                                   start + (turn + 3) % 4};
      add_face(polygon, corners);
      return;
    }
    for (uint32_t i = 0; i < triangle_count(size); ++i) {
      uint32_t c[3];
      if (!blender_triangle(polygon, first_triangle + i, c)) {
        c[0] = start;  // a fan
        c[1] = start + i + 1;
        c[2] = start + i + 2;
      }
      const uint32_t corners[4] = {c[0], c[1], c[2], c[2]};
      add_face(polygon, corners);
    }
  }

  bool splits_along_0_2(size_t polygon, size_t first_triangle) const {
    const auto start = static_cast<uint32_t>(soup_.polygon_starts[polygon]);
    uint32_t uses[4] = {};
    for (size_t i = 0; i < 2; ++i) {
      uint32_t corners[3];
      if (!blender_triangle(polygon, first_triangle + i, corners)) return true;
      for (const uint32_t c : corners)
        ++uses[c - start];
    }
    return uses[0] == 2 && uses[2] == 2;
  }

  void add_face(size_t polygon, const uint32_t (&corners)[4]) {
    const auto count = static_cast<size_t>(mesh_.corners_per_face);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t vertex = soup_.corner_vertices[corners[i]];
      if (vertex >= soup_.vertex_count || usable_vertices_[vertex] == 0) {
        ++mesh_.dropped_faces;
        return;
      }
    }
    for (size_t i = 0; i < count; ++i) {
      mesh_.face_vertices.push_back(soup_.corner_vertices[corners[i]]);
      mesh_.face_corners.push_back(corners[i]);
    }
    mesh_.face_polygons.push_back(static_cast<uint32_t>(polygon));
    if (soup_.material_indices != nullptr) {
      const int slot = std::clamp(soup_.material_indices[polygon], 0, 0xffff);
      mesh_.face_materials.push_back(static_cast<uint16_t>(slot));
    }
    if (soup_.smooth_flags != nullptr)
      mesh_.face_smooth.push_back(soup_.smooth_flags[polygon] != 0 ? 1 : 0);
  }

  void drop_redundant_arrays() {
    auto& polygons = mesh_.face_polygons;
    bool is_identity = true;
    for (size_t i = 0; i < polygons.size() && is_identity; ++i)
      is_identity = polygons[i] == i;
    if (is_identity) polygons = {};
    auto& materials = mesh_.face_materials;
    if (is_uniform(materials) && (materials.empty() || materials[0] == 0)) materials = {};
    auto& smooth = mesh_.face_smooth;
    if (is_uniform(smooth)) {
      mesh_.all_smooth = !smooth.empty() && smooth[0] != 0;
      smooth = {};
    }
  }

  const PolygonSoup& soup_;
  Mesh& mesh_;
  const Cancellation& cancellation_;
  std::vector<uint8_t> usable_vertices_;
};

}  // namespace

Bounds3 Mesh::bounds() const {
  Bounds3 box;
  for (const uint32_t v : face_vertices)
    box.add(positions[v]);
  return box;
}

Mesh build_mesh(const PolygonSoup& soup, const Cancellation& cancellation) {
  Mesh mesh;
  mesh.name = soup.name;
  mesh.positions = to_vec3(soup.positions, soup.vertex_count);
  if (soup.corner_normals != nullptr) {
    mesh.corner_normals = to_vec3(soup.corner_normals, soup.corner_count);
    settle_corner_normals(soup, vertex_normals(soup, cancellation), mesh.corner_normals);
  } else if (soup.vertex_normals != nullptr) {
    mesh.vertex_normals = to_vec3(soup.vertex_normals, soup.vertex_count);
  } else if (has_smooth_faces(soup)) {
    mesh.vertex_normals = vertex_normals(soup, cancellation);
  }
  FaceBuilder(soup, mesh, cancellation).run();
  return mesh;
}

void move_to_world_space(Mesh& mesh, const Transform& object_to_world) {
  const Transform inverse = object_to_world.inverse();
  for (Vec3& p : mesh.positions)
    p = object_to_world.point(p);
  for (auto* normals : {&mesh.vertex_normals, &mesh.corner_normals})
    for (Vec3& n : *normals)
      n = normalize_or(inverse.transposed_vector(n), {});
  move_strands_to_world_space(mesh.strands, object_to_world);
  mesh.is_world_space = true;
  mesh.flips_winding = object_to_world.determinant() < 0.0f;
}

}  // namespace tenniel
