// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "geometry/instance.h"
#include "geometry/mesh.h"
#include "math/ray.h"
#include "math/vec.h"

namespace tenniel {

// What a ray met. `t` and the ids are Embree's; (u, v) are those of the face (of a quad: of the
// bilinear square, see Mesh).
struct Hit {
  float t = 0.0f;
  float u = 0.0f, v = 0.0f;
  uint32_t face = 0;
  uint32_t instance = 0;  // index into the scene's instances
};

struct FaceId {
  uint32_t face = ~0u;
  uint32_t instance = ~0u;
  bool is_known() const { return instance != ~0u; }
};

// A point on a surface with what shading needs, in world space.
struct SurfaceInteraction {
  Vec3 position;
  Vec3 wo;                // unit, to where the path came from
  Vec3 geometric_normal;  // unit, turned to the side of `wo`
  Vec3 shading_normal;    // unit, interpolated, turned with the geometric normal
  bool is_back_facing = false;
  float t = 0.0f;          // length of the ray that came here
  float time = 0.0f;       // of that ray
  float footprint = 0.0f;  // metres: radius of the ray cone here
  const Instance* instance = nullptr;
  const Mesh* mesh = nullptr;
  uint32_t face = 0;
  bool is_second_half = false;         // of a quad: its triangle (2, 3, 1)
  std::array<uint32_t, 3> vertices{};  // of the triangle that was hit, in the mesh
  std::array<float, 3> weights{};      // barycentric, of `vertices`
  std::array<Vec3, 3> corner_points;   // world-space vertices of the triangle
  float u = 0.0f, v = 0.0f;            // weights 1 and 2; what a lamp has in their place

  // Blender's corners at `vertices`. Asked for, not kept: few shaders want them, and they are far
  // from everything else in memory.
  std::array<uint32_t, 3> corners() const {
    return half_of(&mesh->face_corners[face * mesh->stride()], mesh->stride(), is_second_half);
  }

  // Of the instance, at the ray's time.
  Transform object_to_world() const { return instance->object_to_world_at(time); }
  Transform world_to_object() const { return instance->world_to_object_at(time); }
};

// `hit` comes from `ray`; `mesh` is the mesh of `instance`.
SurfaceInteraction make_interaction(const Ray& ray, const Hit& hit, const Instance& instance,
                                    const Mesh& mesh, float footprint);

// Interpolates `attribute` at the point: 4 floats; missing channels are 0, a missing alpha 1.
std::array<float, 4> interpolate(const Attribute& attribute, const SurfaceInteraction& at);

// Blender's parametric coordinates: the weights of the first two corners of its own triangle.
Vec2 parametric_coordinates(const SurfaceInteraction& at);

// From the first corner of Blender's own triangle to the second and to the last, world space. Of a
// hair: along it, and across.
Vec3 parametric_u_direction(const SurfaceInteraction& at);
Vec3 parametric_v_direction(const SurfaceInteraction& at);

// The same surface extended in its tangent plane: position and barycentric weights moved by
// `offset` (world space, perpendicular to the geometric normal). For bump's finite differences.
SurfaceInteraction shifted(const SurfaceInteraction& at, Vec3 offset);

// Smooth normal in object space before any flip, not normalised; for tangent-space normal maps.
Vec3 interpolated_object_normal(const SurfaceInteraction& at);
// Where the point was before displacement, world space.
Vec3 undisplaced_position(const SurfaceInteraction& at);
// Object-space normal to world space, unit.
Vec3 normal_to_world(const SurfaceInteraction& at, Vec3 normal);

// From the point on the flat triangle to the curved surface that its corner normals describe, world
// space; zero on flat faces and where that surface lies below.
Vec3 to_smooth_surface(const SurfaceInteraction& at);

// Start of a ray that leaves `position` toward `direction`, moved off the surface by the error
// bound of the intersection (Waechter & Binder 2019, "A Fast and Robust Method for Avoiding
// Self-Intersection").
inline Vec3 offset_ray_origin(Vec3 position, Vec3 geometric_normal, Vec3 direction) {
  using Floats = float __attribute__((vector_size(16)));
  using Ints = int32_t __attribute__((vector_size(16)));
  constexpr float k_near_origin = 1.0f / 32.0f;
  constexpr float k_float_scale = 1.0f / 65536.0f;
  constexpr float k_int_scale = 256.0f;
  const Vec3 n = face_forward(geometric_normal, direction);
  const Floats p{position.x, position.y, position.z}, along{n.x, n.y, n.z};
  const Ints steps = __builtin_convertvector(k_int_scale * along, Ints);
  const Ints bits = std::bit_cast<Ints>(p) + (p < 0.0f ? -steps : steps);
  const Ints is_near = (p < k_near_origin) & (p > -k_near_origin);
  const Floats moved = is_near ? p + k_float_scale * along : std::bit_cast<Floats>(bits);
  return {moved[0], moved[1], moved[2]};
}

// The same from where more than the position is rounded: a true instance far from its own origin
// rounds by its translation too.
Vec3 offset_from_strand_or_instance(const SurfaceInteraction& at, Vec3 direction);

// The same from any surface.
inline Vec3 offset_ray_origin(const SurfaceInteraction& at, Vec3 direction) {
  if (at.mesh->is_world_space && at.mesh->shape == Shape::faces)
    return offset_ray_origin(at.position, at.geometric_normal, direction);
  return offset_from_strand_or_instance(at, direction);
}

}  // namespace tenniel
