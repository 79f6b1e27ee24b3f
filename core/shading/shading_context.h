// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bsdf/bsdf.h"
#include "geometry/interaction.h"
#include "geometry/visibility.h"
#include "image/voxel_grid.h"
#include "math/transform.h"
#include "media/medium.h"
#include "shading/ray_queries.h"
#include "shading/socket.h"

namespace tenniel {

// Parts of a shader that a program can be compiled for; also which of them a node is asked for.
enum ShaderQuery : uint8_t {
  k_query_scatter = 1,
  k_query_emission = 2,
  k_query_transparency = 4,
  k_query_displacement = 8,
  k_query_volume = 16,  // with k_query_emission: all of a volume
  k_query_aov = 32,     // what AOV Output nodes write
  k_query_surface = k_query_scatter | k_query_emission | k_query_transparency,
};

enum class ShaderDomain : uint8_t { surface, world, lamp };

// More than this, summed over samples, may leave the range of float.
constexpr float k_max_emission = 1e30f;
// Whether a picture can hold it; NaN is not.
constexpr bool is_usable_emission(Spectrum e) {
  const auto fits = [](float x) { return x <= k_max_emission && x >= -k_max_emission; };
  return fits(e.r) && fits(e.g) && fits(e.b);
}

// What the Light Path node may ask about the path that came here.
struct PathInfo {
  RayKind kind = RayKind::camera;  // shadow: evaluated for a shadow ray
  WorldIndex world = 0;
  bool is_light_sample = false;  // emission asked for by next-event estimation: no ray came here
  bool is_singular = false;      // the last bounce was a delta
  bool is_reflection = false;    // the last bounce reflected
  int ray_depth = 0, diffuse_depth = 0, glossy_depth = 0, transmission_depth = 0;
  int transparent_depth = 0;
  bool is_diffuse = false;  // the last bounce was diffuse, off the surface or through it
  int volume_depth = 0;
  bool has_diffuse_ancestor = false;  // some bounce so far was diffuse
};

// Camera facts that Texture Coordinate, Camera Data and Vector Transform read.
struct CameraInfo {
  Transform world_to_camera;  // Blender axes: looks along -Z
  // World point to (x, y) in [0, 1] of the picture, y up.
  Vec2 (*window)(const void* camera, Vec3 world_point) = nullptr;
  const void* camera = nullptr;
};

// What a lamp's tree may ask about its lamp.
struct LampInfo {
  Transform object_to_world;
  float random = 0.0f;  // [0, 1], of Object Info
};

// Everything a node may read, and where closures write. One per worker; lives as long as it.
class ShadingContext {
 public:
  // `register_count`: the most any program of the scene needs.
  void reserve(size_t register_count) { registers_.resize(register_count); }

  // In a World: position = direction, wo = -direction. In a lamp's tree: no instance; the normals
  // are where the lamp shines to. In a volume: no mesh, and in a World's no instance either.
  SurfaceInteraction surface;
  PathInfo path;
  ShaderDomain domain = ShaderDomain::surface;
  uint8_t query = k_query_surface;
  const CameraInfo* camera = nullptr;
  const RayQueries* rays = nullptr;  // null before there is anything to meet
  const LampInfo* lamp = nullptr;    // set in a lamp's tree only
  float material_pass_index = 0.0f;
  GridFilter grid_filter = GridFilter::linear;  // in a volume
  // The normal that closures use where their Normal input is not linked: the shading normal, or
  // what displacement as bump made of it.
  Vec3 closure_normal;

  // Results.
  Bsdf bsdf;
  Spectrum emission;
  Spectrum transparency;
  float holdout = 0.0f;
  float* aovs = nullptr;    // floats of the sample's AovPasses; null: there are none
  MediumProperties medium;  // of a Volume tree; what glows is in `emission`

  template <class T>
  T get(const Input<T>& input) const {
    if (!input.linked()) return input.value;
    const float* r = registers_.data() + input.source;
    if constexpr (std::is_same_v<T, float>)
      return *r;
    else
      return T{r[0], r[1], r[2]};
  }
  template <class T>
  void set(const Output<T>& output, T value) {
    if (!output.used()) return;
    float* r = registers_.data() + output.target;
    if constexpr (std::is_same_v<T, float>) {
      *r = value;
    } else if constexpr (std::is_same_v<T, Vec3>) {
      r[0] = value.x, r[1] = value.y, r[2] = value.z;
    } else {
      r[0] = value.r, r[1] = value.g, r[2] = value.b;
    }
  }
  // A Normal socket: unit length, or the closure normal where it is not linked.
  Vec3 normal(const Input<Vec3>& input) const {
    return input.linked() ? normalize_or(get(input), closure_normal) : closure_normal;
  }
  float read_register(RegisterIndex index) const { return registers_[static_cast<size_t>(index)]; }

  // What a picture cannot hold adds nothing.
  void add_emission(Spectrum radiance) {
    if (is_usable_emission(radiance)) emission += radiance;
  }
  // Clears the results and turns `surface` into the start of an evaluation.
  void begin(uint8_t wanted_query);
  // Makes `normal` (unit) the shading normal of all that follows; before the first lobe only.
  void bend_shading_normal(Vec3 normal);

 private:
  std::vector<float> registers_;
};

}  // namespace tenniel
