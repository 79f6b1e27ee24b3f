// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shading/node_graph.h"

// The scene as the exporter describes it: plain structs and arrays, still with names. Indices refer
// to the lists of SceneDescription; -1 = none. Matrices are 12 floats: three rows of four, acting
// on columns as Blender's. Colours are linear Rec.709. Lengths in metres, angles in radians.
namespace tenniel {

// Arrays are made by the core, filled by Blender, and kept alive by whoever needs them last.
template <class T>
using Buffer = std::shared_ptr<std::vector<T>>;

using Matrix34 = std::array<float, 12>;
constexpr Matrix34 k_identity34 = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct AttributeDesc {
  std::string
      name;  // "" = active UV map, "\x01color" = active colour attribute, else as in Blender
  std::string domain;  // "POINT", "EDGE", "CORNER" or "FACE"
  int channels = 3;    // floats per element: 1, 2, 3 or 4
  Buffer<float> data;  // (elements, channels)
};

struct MeshDesc {
  std::string name;
  Buffer<float> positions;            // (vertices, 3) object space
  Buffer<uint32_t> corner_vertices;   // (corners)
  Buffer<int32_t> polygon_starts;     // (polygons)
  Buffer<int32_t> polygon_sizes;      // (polygons)
  Buffer<uint32_t> triangle_corners;  // (triangles, 3) of Blender's triangulation
  Buffer<int32_t> material_indices;   // (polygons) or none
  Buffer<uint8_t> smooth_flags;       // (polygons) or none
  Buffer<float> vertex_normals;       // (vertices, 3) or none: made of the polygons
  Buffer<float> corner_normals;       // (corners, 3) or none
  // (edges, 2) where a shader asks for attributes of edges, Random Per Island or Pointiness, else
  // none
  Buffer<uint32_t> edge_vertices;
  std::vector<AttributeDesc> attributes;
  std::array<float, 3> texture_space_location{0, 0, 0};
  std::array<float, 3> texture_space_size{1, 1, 1};
  // FACES, or in their place hairs (RIBBONS, TUBES) or points (SPHERES). Of those `positions` are
  // the keys, attributes lie on POINT (key) or FACE (hair or point), and what faces need is empty.
  std::string shape = "FACES";
  // (positions), or none: hairs taper from root to tip, by a power of the way that `radius_shape`
  // bends (0: straight; towards -1 thick for long, towards 1 thin soon).
  Buffer<float> radii;
  float root_radius = 0.0f, tip_radius = 0.0f, radius_shape = 0.0f;
  bool closes_tip = false;            // the last key of each hair has no radius
  Buffer<int32_t> strand_sizes;       // (hairs) keys of each
  Matrix34 to_object = k_identity34;  // from where `positions` are to object space
  int ribbon_pieces = 5;              // flat ones between two keys
  int first_strand = 0;               // number of the first, for the random numbers of each
};

// Where a thing exists: `worlds` bit w, `ray_kinds` bit k (camera, diffuse, glossy, transmission,
// volume scatter, shadow).
struct VisibilityDesc {
  uint32_t worlds = 0x1f;
  uint32_t ray_kinds = 0x3f;

  bool operator==(const VisibilityDesc&) const = default;
};

struct LookingGlassDesc {
  int dream = 0;                     // 0 = no looking glass, else 1..4
  std::string entry = "REFLECTION";  // REFLECTION, TRANSMISSION, BOTH
  std::string reentry = "STAY";      // STAY, TOGGLE
  bool first_seen_only = false;
};

struct InstanceDesc {
  std::string name;
  int mesh = -1;
  Matrix34 object_to_world = k_identity34;
  // Where it is at 2 to 129 times, equally far apart over the shutter; empty: it rests.
  std::vector<Matrix34> motion;
  VisibilityDesc visibility;
  LookingGlassDesc looking_glass;
  std::vector<int> materials;         // per slot; -1 = Blender's default material
  std::vector<int> behind_materials;  // per slot in the dreams; empty = the same
  std::array<float, 4> color{1, 1, 1, 1};
  float pass_index = 0.0f;
  float random = 0.0f;  // [0, 1]
  bool is_holdout = false;
  float terminator_cutoff = 0.0f;           // cosine: Cycles' shadow_terminator_geometry_offset
  std::array<float, 3> generated{0, 0, 0};  // of the instancer
  std::array<float, 2> instancer_uv{0, 0};
  std::map<std::string, std::array<float, 4>> attributes;  // for Attribute nodes off geometry
  std::vector<int> grids;           // what fills it, each by its name as an attribute
  bool has_scaled_density = false;  // its medium is thinner the larger it is scaled
};

struct MaterialDesc {
  std::string name;
  NodeGraph graph;
  float pass_index = 0.0f;
  std::string displacement_method = "BUMP";  // BUMP, DISPLACEMENT, BOTH
  bool use_transparent_shadow = true;
  bool sample_as_light = true;
  std::string volume_interpolation = "LINEAR";  // LINEAR, CUBIC: between voxels
  float volume_step_rate = 1.0f;                // of the steps through it, where it varies
};

struct LightDesc {
  std::string name;
  std::string type = "POINT";  // POINT, SPOT, AREA, SUN
  Matrix34 object_to_world = k_identity34;
  std::array<float, 3> color{1, 1, 1};
  float energy = 0.0f;       // W; sun: W/m^2
  float radius = 0.0f;       // point, spot: metres
  float spot_size = 0.785f;  // full angle
  float spot_blend = 0.15f;
  std::string shape = "SQUARE";  // SQUARE, RECTANGLE, DISK, ELLIPSE
  float size_x = 1.0f, size_y = 1.0f;
  float spread = 3.14159265f;
  float angle = 0.0f;  // sun: full angle
  NodeGraph graph;     // empty = no nodes
  VisibilityDesc visibility;
  bool casts_shadow = true;
  bool use_mis = true;
  int max_bounces = 1024;
  float random = 0.0f;
};

struct WorldDesc {
  std::string name;
  NodeGraph graph;  // empty: `color` is the background
  std::array<float, 3> color{0, 0, 0};
  VisibilityDesc visibility;           // only ray kinds count
  std::string sampling = "AUTOMATIC";  // NONE, AUTOMATIC, MANUAL
  int map_resolution = 1024;           // for MANUAL: height of the importance map
  int max_bounces = 1024;
  float volume_step_size = 1.0f;  // metres, through its volume where that varies

  bool operator==(const WorldDesc&) const = default;
};

struct ImageTileDesc {
  int number = 0;  // UDIM 1001...; 0 for a plain image
  std::string path;
  Buffer<float> pixels;  // (height, width, 4) bottom row first, instead of a path
  int width = 0, height = 0;
};

struct ImageDesc {
  std::string name;
  std::vector<ImageTileDesc> tiles;  // one with number 0, or the tiles of a UDIM; none = missing
  std::string colorspace = "sRGB";
  std::string alpha_mode = "STRAIGHT";  // STRAIGHT, PREMUL, CHANNEL_PACKED, NONE
  bool is_data = false;
  bool is_float = false;  // of `pixels`: scene-linear, else encoded bytes in [0, 1]
};

// Values in the unit cube: of a simulation in the texture space of its domain, of a Point Density;
// or the grid of that name in an OpenVDB file, in object space.
struct GridDesc {
  std::string name;
  std::string path;  // of the file; the rest is not used then
  int width = 0, height = 0, depth = 0;
  int channels = 1;      // floats per voxel: 1, 3 or 4
  Buffer<float> values;  // (depth, height, width, channels)
};

// A pass that AOV Output nodes of this name write.
struct AovDesc {
  std::string name;
  bool is_color = false;
};

struct CameraDesc {
  std::string type = "PERSP";  // PERSP, ORTHO, PANO (equirectangular)
  Matrix34 camera_to_world = k_identity34;
  std::vector<Matrix34> motion;                                     // as of an instance
  float lens = 50.0f, sensor_width = 36.0f, sensor_height = 24.0f;  // mm
  std::string sensor_fit = "AUTO";
  float shift_x = 0.0f, shift_y = 0.0f;
  float ortho_scale = 6.0f;
  float clip_start = 0.1f, clip_end = 1000.0f;
  float aperture_radius = 0.0f, focus_distance = 10.0f;
  int aperture_blades = 0;
  float aperture_rotation = 0.0f, aperture_ratio = 1.0f;
  float longitude_min = -3.14159265f, longitude_max = 3.14159265f;
  float latitude_min = -1.57079633f, latitude_max = 1.57079633f;
  float pixel_aspect_x = 1.0f, pixel_aspect_y = 1.0f;
};

struct RenderSettings {
  int width = 1, height = 1;  // of the whole picture in pixels
  int border_x = 0, border_y = 0, border_width = 0, border_height = 0;  // width 0 = the whole
  int samples = 128;
  int sample_offset = 0;
  uint32_t seed = 0;
  int threads = 0;          // 0 = all
  float time_limit = 0.0f;  // seconds; 0 = none
  int max_bounces = 12, diffuse_bounces = 4, glossy_bounces = 4, transmission_bounces = 12;
  int volume_bounces = 0;
  int transparent_max_bounces = 8;
  int min_light_bounces = 0;       // no roulette before
  bool use_radiance_cache = true;  // learn for a moment what bounces bring, for the roulette
  float clamp_direct = 0.0f, clamp_indirect = 10.0f;  // 0 = none
  float blur_glossy = 1.0f;
  bool caustics_reflective = true, caustics_refractive = true;
  bool film_transparent = false;
  float film_exposure = 1.0f;
  float pass_alpha_threshold = 0.5f;  // what is less opaque leaves such passes to what is behind
  std::string pixel_filter = "BLACKMAN_HARRIS";  // BOX, GAUSSIAN, BLACKMAN_HARRIS
  float filter_width = 1.5f;
  float occlusion_distance = 10.0f;  // of Ambient Occlusion nodes whose Distance is 0
  float volume_step_rate = 1.0f;     // of all steps through volumes
  int texture_limit = 0;             // longest side in pixels; 0 = none
  int start_world = 0;               // the camera's world: a dream can be looked at directly
};

struct SceneDescription {
  std::vector<MeshDesc> meshes;
  std::vector<InstanceDesc> instances;
  std::vector<MaterialDesc> materials;
  std::vector<LightDesc> lights;
  std::vector<WorldDesc> worlds;  // 1 to 5; a dream without its own uses the first
  std::vector<ImageDesc> images;
  std::vector<GridDesc> grids;
  std::vector<AovDesc> aovs;
  CameraDesc camera;
  RenderSettings settings;
};

}  // namespace tenniel
