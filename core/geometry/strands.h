// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

struct Hit;
struct Mesh;
struct Ray;
struct SurfaceInteraction;

// What a Mesh is made of. Ribbons are strips that turn to the ray and are shaded as if round.
enum class Shape : uint8_t { faces, ribbons, tubes, spheres };

// A control point of a hair, or a sphere.
struct StrandKey {
  Vec3 position;
  float radius = 0.0f;
};

// Hairs (Catmull-Rom curves through their keys) or spheres, as Embree reads them. A segment runs
// between the second and the third of four keys in a row; the ends of a hair are there twice.
struct Strands {
  std::vector<StrandKey> keys;
  std::vector<uint32_t> segments;  // first of the four keys of each; empty for spheres
  int ribbon_pieces = 1;           // flat ones that a segment of a ribbon is cut into
};

// What `build_strands` makes its mesh of; spans must outlive the call.
struct StrandSoup {
  std::string name;
  Shape shape = Shape::ribbons;
  const float* positions = nullptr;  // (key_count, 3)
  const float* radii = nullptr;      // (key_count); not read by what measures
  size_t key_count = 0;
  const int32_t* sizes = nullptr;  // (strand_count) keys of each; not for spheres
  size_t strand_count = 0;
  Transform to_object;  // from where the positions are to object space; radii stay
  int ribbon_pieces = 1;
};

// A Mesh without faces. In its attributes `vertex` counts the keys that came in and `face` the
// hairs (Mesh::face_polygons holds the hair of each segment); of spheres both count spheres. Parts
// that are not finite are left out and counted.
Mesh build_strands(const StrandSoup& soup);

// Per key the distance from the root along straight lines, as a part of the whole; per hair that.
struct StrandLengths {
  std::vector<float> intercepts, lengths;
};
StrandLengths measure_strands(const StrandSoup& soup);

// Particle hair: radius at each key by the way from the root. `shape` in [-1, 1] bends the taper.
struct Taper {
  float root = 0.0f, tip = 0.0f, shape = 0.0f;
  bool closes_tip = false;
};
std::vector<float> tapered_radii(const StrandSoup& soup, const Taper& taper);

// Whether `object_to_world` keeps round what is round: strands can be carried to world space.
bool keeps_shape(const Transform& object_to_world);
void move_strands_to_world_space(Strands& strands, const Transform& object_to_world);

// Completes an interaction of which all is known but what the surface itself says.
void place_on_strand(const Ray& ray, const Hit& hit, SurfaceInteraction& at);

// Of a point on a hair; elsewhere as Blender has it: no thickness.
bool is_on_hair(const SurfaceInteraction& at);
float strand_thickness(const SurfaceInteraction& at);
// Along the hair, world space, as long as the segment; 0 off hairs.
Vec3 strand_direction(const SurfaceInteraction& at);

// Of a point on a sphere of a point cloud.
bool is_on_sphere(const SurfaceInteraction& at);
Vec3 sphere_center(const SurfaceInteraction& at);  // world space
float sphere_radius(const SurfaceInteraction& at);

}  // namespace tenniel
