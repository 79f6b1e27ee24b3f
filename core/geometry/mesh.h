// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/attributes.h"
#include "geometry/strands.h"
#include "math/bounds.h"
#include "math/cancellation.h"
#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

// Polygons of a mesh as Blender stores them; input of `build_mesh`. Spans must outlive the call.
struct PolygonSoup {
  std::string name;
  const float* positions = nullptr;  // (vertex_count, 3) object space
  size_t vertex_count = 0;
  const uint32_t* corner_vertices = nullptr;  // (corner_count) vertex of each corner
  size_t corner_count = 0;
  const int32_t* polygon_starts = nullptr;  // (polygon_count) first corner
  const int32_t* polygon_sizes = nullptr;   // (polygon_count) number of corners
  size_t polygon_count = 0;
  // (n, 3) corners of Blender's own triangulation, in polygon order, size - 2 of them a polygon.
  const uint32_t* triangle_corners = nullptr;
  size_t triangle_count = 0;
  const int32_t* material_indices = nullptr;  // (polygon_count) or null: all 0
  const uint8_t* smooth_flags = nullptr;      // (polygon_count) or null: all flat
  const float* vertex_normals = nullptr;      // (vertex_count, 3) or null: made of the polygons
  const float* corner_normals = nullptr;      // (corner_count, 3) or null; wins over vertex normals
};

// Triangles, or quads where the source has any: Embree traces a quad in 0.65 of the memory of two
// triangles at the same speed. In a quad mesh a triangle repeats its last corner.
// A quad (0,1,2,3) is split along 1-3 into (0,1,3) and (2,3,1), as Embree does; `build_mesh` turns
// the corners so that this is Blender's diagonal too.
// Hairs and points take the place of a mesh: `shape` tells, and they have `strands` but no faces.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;  // object space; world space if `is_world_space`
  int corners_per_face = 3;     // 3 or 4
  Shape shape = Shape::faces;
  std::vector<uint32_t> face_vertices;   // (face_count, corners_per_face): Embree's index buffer
  std::vector<uint32_t> face_corners;    // same shape: Blender's corner (loop) of each
  std::vector<uint32_t> face_polygons;   // (face_count) Blender's polygon; empty: the same index
  std::vector<uint16_t> face_materials;  // (face_count) material slot; empty: all 0
  std::vector<uint8_t> face_smooth;      // (face_count) 1 = interpolate normals; empty: see below
  bool all_smooth = false;               // read when `face_smooth` is empty
  std::vector<Vec3> vertex_normals;      // same space as positions, unit; may be empty
  std::vector<Vec3> corner_normals;      // per Blender corner; wins over vertex_normals
  std::vector<Vec3> undisplaced;         // positions before displacement, object space; or empty
  std::vector<Attribute> attributes;
  std::vector<int16_t> slot_of_attribute;  // AttributeIds id -> index in `attributes`, -1 = none
  bool is_world_space = false;             // flattened into the top level
  bool flips_winding = false;              // world space by a mirroring transform
  uint32_t dropped_faces = 0;              // non-finite or with an index out of range
  Strands strands;                         // same space as positions

  size_t stride() const { return static_cast<size_t>(corners_per_face); }
  size_t face_count() const { return face_vertices.size() / stride(); }
  bool is_empty() const {
    return shape == Shape::faces ? face_vertices.empty() : strands.keys.empty();
  }
  int material_slot(uint32_t face) const {
    return face_materials.empty() ? 0 : face_materials[face];
  }
  bool is_smooth(uint32_t face) const {
    return face_smooth.empty() ? all_smooth : face_smooth[face] != 0;
  }
  void prefetch(uint32_t face) const {
    __builtin_prefetch(face_vertices.data() + face * stride());
    __builtin_prefetch(face_smooth.data() + face);
  }
  // The attribute of an interned name; null where this mesh has none.
  const Attribute* attribute(int id) const {
    if (id < 0 || id >= static_cast<int>(slot_of_attribute.size())) return nullptr;
    const int slot = slot_of_attribute[static_cast<size_t>(id)];
    return slot < 0 ? nullptr : &attributes[static_cast<size_t>(slot)];
  }
  Bounds3 bounds() const;  // of the vertices that faces use
};

// Checks every index, drops faces that are non-finite or out of range (counted), turns quads to
// Blender's diagonal. Throws nothing but bad_alloc and Cancelled.
Mesh build_mesh(const PolygonSoup& soup, const Cancellation& cancellation = {});

// Carries positions and normals to world space for the one instance that uses the mesh. Attributes
// stay as they are, so tangents are to be added before.
void move_to_world_space(Mesh& mesh, const Transform& object_to_world);

// One of the (up to two) triangles of a face: which vertices and corners carry the weights.
struct FaceTriangle {
  std::array<uint32_t, 3> vertices;
  std::array<uint32_t, 3> corners;
};
// Three of the `stride` ids of a face: `second` picks the half (2,3,1) of a quad; of a triangle in
// a quad mesh that one is empty (zero area).
inline std::array<uint32_t, 3> half_of(const uint32_t* ids, size_t stride, bool second) {
  if (second) return {ids[2], ids[3], ids[1]};
  return {ids[0], ids[1], ids[stride - 1]};
}
inline FaceTriangle face_triangle(const Mesh& mesh, uint32_t face, bool second) {
  const size_t stride = mesh.stride();
  return {half_of(&mesh.face_vertices[face * stride], stride, second),
          half_of(&mesh.face_corners[face * stride], stride, second)};
}

// Adds attributes `name` (3 floats a corner: unit tangent along +u, 0 where there is none) and
// `name + ".sign"` (1 float: the sign of the bitangent) after MikkTSpace (Mikkelsen 2008) from the
// UV attribute `uv`.
void add_tangents(Mesh& mesh, const Attribute& uv, const std::string& name,
                  const Cancellation& cancellation = {});

}  // namespace tenniel
