// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/attributes.h"
#include "image/voxel_grid.h"
#include "shading/aov.h"
#include "shading/grid_medium.h"
#include "shading/node_graph.h"
#include "shading/program.h"
#include "shading/sun_disk.h"

namespace tenniel {

class NodeRegistry;
class Texture;

enum class DisplacementMethod : uint8_t { bump, displacement, both };

// The compiled programs of one shader tree (of a material, a World or a lamp).
struct Material {
  std::string name;
  Program surface;       // everything at a hit
  Program transparency;  // what a shadow ray needs: `ShadingContext::transparency`
  Program emission;      // what light sampling needs: `ShadingContext::emission`
  Program aovs;          // what passes of the artist's own are given, after `surface`
  Program volume;        // what fills it: `ShadingContext::medium` and `emission`
  float pass_index = 0.0f;
  bool scatters = false;        // may add lobes
  bool emits = false;           // may be a light
  bool is_transparent = false;  // may let shadow rays through
  bool is_emission_constant = false;
  Spectrum constant_emission;
  bool has_subsurface = false;    // may add lobes that go below the surface
  bool bends_subsurface = false;  // and around another normal than the surface's own
  bool has_surface = true;        // false: only Volume is linked (index-matched boundary)
  bool has_volume = false;        // may be filled with something
  bool is_volume_constant = false;
  MediumProperties constant_volume;  // its emission included
  std::optional<GridMedium> grid_medium;
  GridFilter grid_filter = GridFilter::linear;
  float volume_step_rate = 1.0f;  // longer steps where it varies; in a World metres
  // How far true displacement moves the surface, world space; read only if `displaces`.
  ProgramInput<Vec3> displacement;
  DisplacementMethod displacement_method = DisplacementMethod::bump;
  bool displaces = false;  // moves vertices: linked, and its method is not bump
  bool use_transparent_shadow = true;
  bool sample_as_light = true;

  // Runs `volume` at `context.surface`; the result is part of the context.
  const MediumProperties& evaluate_volume(ShadingContext& context) const;
  std::vector<SunDisk> suns;    // of its Sky Textures
  bool has_hidden_sun = false;  // a sun that stands where only its texture knows
};

// Where a tree stands and what it may refer to while it is compiled.
struct MaterialSource {
  const NodeGraph* graph = nullptr;  // null or without output: nothing is emitted or scattered
  ShaderDomain domain = ShaderDomain::surface;
  DisplacementMethod displacement = DisplacementMethod::bump;
};

struct CompileContext {
  AttributeIds* attributes = nullptr;
  const std::vector<AovPass>* aovs = nullptr;
  // Texture of image `index` as sampled by a node with these settings; null where it is missing.
  std::function<const Texture*(int index, const std::string& interpolation,
                               const std::string& extension)>
      texture;
  std::function<const VoxelGrid*(int index)> grid;  // null where there is none
  // Reports something that cannot be honoured: the node's name and a sentence.
  std::function<void(const std::string& node, const std::string& text)> report;
  const NodeRegistry* registry = nullptr;  // null: node_registry()
  bool optimise = true;                    // off: neither folds nor shares nodes (for tests)
};

// Runs the passes of shading/compiler.cpp. Never throws for a bad graph (cycles, unknown nodes or
// sockets, wrong types): what cannot be used is reported and replaced by its default.
Material compile_material(const MaterialSource& source, CompileContext& context);

// Tangents a material needs: UV attribute names ("" = the active one) of its Normal Map,
// Tangent and Vector Displacement nodes, so that meshes build them before the first ray.
std::vector<std::string> required_tangents(const NodeGraph& graph);

}  // namespace tenniel
