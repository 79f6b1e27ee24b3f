// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "geometry/instance.h"
#include "geometry/mesh.h"
#include "math/numeric.h"

// Meshes for the unit tests of this folder.
namespace tenniel::test {

// Owns what a PolygonSoup points to. Polygons are lists of vertices; the triangulation is a fan
// from each polygon's first corner, which is how Blender splits a flat convex polygon.
struct Polygons {
  std::vector<float> positions;
  std::vector<uint32_t> corner_vertices;
  std::vector<int32_t> starts, sizes;
  std::vector<uint32_t> triangle_corners;
  std::vector<int32_t> materials;
  std::vector<uint8_t> smooth;
  std::vector<float> vertex_normals;

  void add_vertex(Vec3 p) { positions.insert(positions.end(), {p.x, p.y, p.z}); }

  void add_polygon(const std::vector<uint32_t>& vertices, int first_of_fan = 0) {
    const auto start = static_cast<uint32_t>(corner_vertices.size());
    const auto size = static_cast<uint32_t>(vertices.size());
    const auto first = static_cast<uint32_t>(first_of_fan);
    starts.push_back(static_cast<int32_t>(start));
    sizes.push_back(static_cast<int32_t>(size));
    corner_vertices.insert(corner_vertices.end(), vertices.begin(), vertices.end());
    for (uint32_t i = 1; i + 1 < size; ++i)
      for (const uint32_t k : {first, first + i, first + i + 1})
        triangle_corners.push_back(start + k % size);
  }

  PolygonSoup soup() const {
    PolygonSoup s;
    s.name = "test";
    s.positions = positions.data();
    s.vertex_count = positions.size() / 3;
    s.corner_vertices = corner_vertices.data();
    s.corner_count = corner_vertices.size();
    s.polygon_starts = starts.data();
    s.polygon_sizes = sizes.data();
    s.polygon_count = starts.size();
    s.triangle_corners = triangle_corners.data();
    s.triangle_count = triangle_corners.size() / 3;
    if (!materials.empty()) s.material_indices = materials.data();
    if (!smooth.empty()) s.smooth_flags = smooth.data();
    if (!vertex_normals.empty()) s.vertex_normals = vertex_normals.data();
    return s;
  }
};

// Sphere around the origin: quads between `rows` latitudes, triangles at the poles, smooth.
inline Mesh sphere(float radius, int rows = 16, int columns = 32) {
  Polygons p;
  const auto vertex = [&](float theta, float phi) {
    const Vec3 n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    p.add_vertex(n * radius);
    p.vertex_normals.insert(p.vertex_normals.end(), {n.x, n.y, n.z});
  };
  vertex(0.0f, 0.0f);
  for (int r = 1; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      vertex(k_pi * static_cast<float>(r) / static_cast<float>(rows),
             k_two_pi * static_cast<float>(c) / static_cast<float>(columns));
  vertex(k_pi, 0.0f);
  const auto id = [&](int r, int c) {
    if (r == 0) return 0u;
    if (r == rows) return static_cast<uint32_t>((rows - 1) * columns + 1);
    return static_cast<uint32_t>((r - 1) * columns + c % columns + 1);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (r == 0)
        p.add_polygon({id(0, 0), id(1, c), id(1, c + 1)});
      else if (r == rows - 1)
        p.add_polygon({id(r, c), id(rows, 0), id(r, c + 1)});
      else
        p.add_polygon({id(r, c), id(r + 1, c), id(r + 1, c + 1), id(r, c + 1)});
    }
  }
  p.smooth.assign(p.starts.size(), 1);
  return build_mesh(p.soup());
}

inline Instance place(uint32_t mesh, const Transform& object_to_world = {}) {
  Instance instance;
  instance.mesh = mesh;
  instance.object_to_world = object_to_world;
  instance.world_to_object = object_to_world.inverse();
  return instance;
}

}  // namespace tenniel::test
