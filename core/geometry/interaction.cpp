// SPDX-License-Identifier: Apache-2.0
#include "geometry/interaction.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr float k_unit_roundoff_steps = 256.0f * 0x1p-23f;  // of Waechter & Binder's integer scale

constexpr float k_tube_error = 2e-4f;  // in thicknesses

// Which half of a quad (u, v) lies in. A triangle among quads has no second half.
bool in_second_half(const Mesh& mesh, const uint32_t* face_vertices, const Hit& hit) {
  return mesh.corners_per_face == 4 && hit.u + hit.v > 1.0f && face_vertices[2] != face_vertices[3];
}

// Per-corner normals of the triangle, in the mesh's space; null where the face is flat.
struct CornerNormals {
  const Vec3 *a = nullptr, *b = nullptr, *c = nullptr;
};
inline CornerNormals smooth_normals(const SurfaceInteraction& at) {
  const Mesh& mesh = *at.mesh;
  if (!mesh.is_smooth(at.face)) return {};
  const bool by_corner = !mesh.corner_normals.empty();
  const auto& normals = by_corner ? mesh.corner_normals : mesh.vertex_normals;
  if (normals.empty()) return {};
  const auto ids = by_corner ? at.corners() : at.vertices;
  return {&normals[ids[0]], &normals[ids[1]], &normals[ids[2]]};
}

Vec3 weighted(const std::array<float, 3>& w, Vec3 a, Vec3 b, Vec3 c) {
  return a * w[0] + b * w[1] + c * w[2];
}

// Corners, position and the geometric normal on the side that the object's own front is on.
Vec3 place_on_triangle(SurfaceInteraction& at) {
  const Mesh& mesh = *at.mesh;
  const auto& v = at.vertices;
  const Vec3 p0 = mesh.positions[v[0]];
  Vec3 edge_1 = mesh.positions[v[1]] - p0, edge_2 = mesh.positions[v[2]] - p0;
  // From one corner along the edges: the rounding is that of the edges, not of three large points.
  const Vec3 inside = edge_1 * at.weights[1] + edge_2 * at.weights[2];
  bool flips = mesh.flips_winding;
  if (mesh.is_world_space) {
    at.position = p0 + inside;
    at.corner_points[0] = p0;
  } else {
    const Transform m = at.object_to_world();
    at.position = m.point(p0 + inside);
    at.corner_points[0] = m.point(p0);
    edge_1 = m.vector(edge_1);
    edge_2 = m.vector(edge_2);
    flips = m.determinant() < 0.0f;
  }
  at.corner_points[1] = at.corner_points[0] + edge_1;
  at.corner_points[2] = at.corner_points[0] + edge_2;
  const Vec3 normal = cross(edge_1, edge_2);
  return flips ? -normal : normal;
}

// Everything of `at` that follows from where on a face the hit lies.
void place_on_face(const Hit& hit, SurfaceInteraction& at) {
  const Mesh& mesh = *at.mesh;
  const uint32_t* ids = &mesh.face_vertices[hit.face * mesh.stride()];
  const bool second = in_second_half(mesh, ids, hit);
  at.is_second_half = second;
  at.vertices = half_of(ids, mesh.stride(), second);
  at.u = second ? 1.0f - hit.u : hit.u;
  at.v = second ? 1.0f - hit.v : hit.v;
  at.weights = {1.0f - at.u - at.v, at.u, at.v};

  // A sliver whose cross product vanishes still needs some unit normal: that of the ray.
  const Vec3 front = normalize_or(place_on_triangle(at), at.wo);
  at.is_back_facing = dot(front, at.wo) < 0.0f;
  at.geometric_normal = at.is_back_facing ? -front : front;
  at.shading_normal = at.geometric_normal;
  const CornerNormals normals = smooth_normals(at);
  if (normals.a != nullptr) {
    Vec3 n = weighted(at.weights, *normals.a, *normals.b, *normals.c);
    if (!mesh.is_world_space) n = at.world_to_object().transposed_vector(n);
    n = normalize_or(n, front);
    at.shading_normal = at.is_back_facing ? -n : n;
  }
}

}  // namespace

SurfaceInteraction make_interaction(const Ray& ray, const Hit& hit, const Instance& instance,
                                    const Mesh& mesh, float footprint) {
  SurfaceInteraction at;
  at.wo = -ray.direction;
  at.t = hit.t;
  at.time = ray.time;
  at.footprint = footprint;
  at.instance = &instance;
  at.mesh = &mesh;
  at.face = hit.face;
  if (mesh.shape == Shape::faces)
    place_on_face(hit, at);
  else
    place_on_strand(ray, hit, at);
  return at;
}

std::array<float, 4> interpolate(const Attribute& attribute, const SurfaceInteraction& at) {
  std::array<float, 4> result{0.0f, 0.0f, 0.0f, 1.0f};
  const size_t channels = attribute.channels;
  if (attribute.domain == AttributeDomain::face) {
    const auto& polygons = at.mesh->face_polygons;
    const size_t polygon = polygons.empty() ? at.face : polygons[at.face];
    std::copy_n(&attribute.data[polygon * channels], channels, result.begin());
    return result;
  }
  const auto ids = attribute.domain == AttributeDomain::vertex ? at.vertices : at.corners();
  const float* a = &attribute.data[ids[0] * channels];
  const float* b = &attribute.data[ids[1] * channels];
  const float* c = &attribute.data[ids[2] * channels];
  for (size_t i = 0; i < channels; ++i)
    result[i] = a[i] * at.weights[0] + b[i] * at.weights[1] + c[i] * at.weights[2];
  return result;
}

namespace {

// Which corner of the triangle that was hit comes first in Blender's. `build_mesh` turns a quad,
// and Embree has its second half start elsewhere; Blender begins both halves at their first corner.
size_t first_corner(const SurfaceInteraction& at) {
  if (at.mesh->corners_per_face == 3) return 0;
  const uint32_t* v = &at.mesh->face_vertices[at.face * size_t{4}];
  if (v[2] == v[3]) return 0;
  const auto corners = at.corners();
  return static_cast<size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
}

}  // namespace

Vec2 parametric_coordinates(const SurfaceInteraction& at) {
  const size_t first = first_corner(at);
  return {at.weights[first], at.weights[(first + 1) % 3]};
}

Vec3 parametric_u_direction(const SurfaceInteraction& at) {
  const size_t first = first_corner(at);
  return at.corner_points[(first + 1) % 3] - at.corner_points[first];
}

Vec3 parametric_v_direction(const SurfaceInteraction& at) {
  const size_t first = first_corner(at);
  return at.corner_points[(first + 2) % 3] - at.corner_points[first];
}

SurfaceInteraction shifted(const SurfaceInteraction& at, Vec3 offset) {
  SurfaceInteraction moved = at;
  moved.position += offset;
  const Vec3 edge_1 = at.corner_points[1] - at.corner_points[0];
  const Vec3 edge_2 = at.corner_points[2] - at.corner_points[0];
  const Vec3 normal = cross(edge_1, edge_2);
  const float scale = 1.0f / length_squared(normal);
  const float du = dot(cross(offset, edge_2), normal) * scale;
  const float dv = dot(cross(edge_1, offset), normal) * scale;
  if (!std::isfinite(du) || !std::isfinite(dv)) return moved;
  moved.u += du;
  moved.v += dv;
  moved.weights = {1.0f - moved.u - moved.v, moved.u, moved.v};
  return moved;
}

Vec3 interpolated_object_normal(const SurfaceInteraction& at) {
  // World to object: the transposed map undoes the inverse transposed one.
  const auto to_object = [map = at.object_to_world()](Vec3 n) {
    return normalize_or(map.transposed_vector(n), {});
  };
  const CornerNormals normals = smooth_normals(at);
  if (normals.a == nullptr)
    return to_object(at.is_back_facing ? -at.geometric_normal : at.geometric_normal);
  if (!at.mesh->is_world_space) return weighted(at.weights, *normals.a, *normals.b, *normals.c);
  return weighted(at.weights, to_object(*normals.a), to_object(*normals.b), to_object(*normals.c));
}

Vec3 undisplaced_position(const SurfaceInteraction& at) {
  if (!at.mesh || at.mesh->undisplaced.empty()) return at.position;
  const auto& p = at.mesh->undisplaced;
  return at.object_to_world().point(
      weighted(at.weights, p[at.vertices[0]], p[at.vertices[1]], p[at.vertices[2]]));
}

Vec3 normal_to_world(const SurfaceInteraction& at, Vec3 normal) {
  return normalize_or(at.world_to_object().transposed_vector(normal), {0.0f, 0.0f, 1.0f});
}

// Along each edge a parabola that stands upright on the normals at its ends.
Vec3 to_smooth_surface(const SurfaceInteraction& at) {
  const CornerNormals corners = smooth_normals(at);
  if (corners.a == nullptr) return {};
  const auto outward = [&at](Vec3 n) {
    if (!at.mesh->is_world_space) n = at.instance->world_to_object.transposed_vector(n);
    n = normalize_or(n, {});
    return at.is_back_facing ? -n : n;
  };
  const std::array<Vec3, 3> n{outward(*corners.a), outward(*corners.b), outward(*corners.c)};
  float height = 0.0f;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    height +=
        at.weights[i] * at.weights[j] * dot(n[j] - n[i], at.corner_points[j] - at.corner_points[i]);
  }
  const Vec3 normal = weighted(at.weights, n[0], n[1], n[2]);
  return height > 0.0f && is_finite(normal) ? normal * height : Vec3();
}

Vec3 offset_from_strand_or_instance(const SurfaceInteraction& at, Vec3 direction) {
  Vec3 origin = offset_ray_origin(at.position, at.geometric_normal, direction);
  // Embree finds a tube by steps, which end a little beside it.
  if (at.mesh->shape == Shape::tubes)
    origin += face_forward(at.geometric_normal, direction) * (strand_thickness(at) * k_tube_error);
  if (at.mesh->is_world_space) return origin;
  const Vec3 t = at.object_to_world().translation;
  const float size = std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)});
  return origin + face_forward(at.geometric_normal, direction) * (size * k_unit_roundoff_steps);
}

}  // namespace tenniel
