// SPDX-License-Identifier: Apache-2.0
// Shader trees to programs, and the images they read to textures.
#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "image/image_io.h"
#include "scene/compile_scene.h"

namespace tenniel {

namespace {

Interpolation interpolation_of(const std::string& name) {
  return name == "Closest"                    ? Interpolation::closest
         : name == "Cubic" || name == "Smart" ? Interpolation::cubic
                                              : Interpolation::linear;
}

Extension extension_of(const std::string& name) {
  return name == "EXTEND" ? Extension::extend
         : name == "CLIP" ? Extension::clip
                          : Extension::repeat;
}

AlphaMode alpha_mode_of(const std::string& name) {
  return name == "PREMUL"           ? AlphaMode::premultiplied
         : name == "CHANNEL_PACKED" ? AlphaMode::channel_packed
         : name == "NONE"           ? AlphaMode::none
                                    : AlphaMode::straight;
}

// Loads each image once, however many nodes sample it, and each way of sampling once.
class TextureTable {
 public:
  TextureTable(SceneCompiler& compiler) : compiler_(compiler) {}

  const Texture* get(int index, const std::string& interpolation, const std::string& extension) {
    if (index < 0 || static_cast<size_t>(index) >= compiler_.description.images.size())
      return nullptr;
    const auto key = std::make_tuple(index, interpolation, extension);
    if (const auto found = textures_.find(key); found != textures_.end()) return found->second;
    const Tiles& tiles = load(index);
    const Texture* texture = nullptr;
    if (!tiles.empty()) {
      const Interpolation filter = interpolation_of(interpolation);
      const Extension edge = extension_of(extension);
      auto made = tiles.begin()->first == 0
                      ? std::make_unique<const Texture>(tiles.begin()->second, filter, edge)
                      : std::make_unique<const Texture>(tiles, filter, edge);
      texture = compiler_.scene.textures.emplace_back(std::move(made)).get();
    }
    textures_.emplace(key, texture);
    return texture;
  }

 private:
  using Tiles = std::map<int, std::shared_ptr<const Image>>;

  const Tiles& load(int index) {
    if (const auto found = images_.find(index); found != images_.end()) return found->second;
    Tiles& tiles = images_[index];
    ImageDesc& desc = compiler_.description.images[static_cast<size_t>(index)];
    const ImageLoadOptions options{desc.colorspace, alpha_mode_of(desc.alpha_mode), desc.is_data,
                                   compiler_.description.settings.texture_limit};
    if (!desc.is_data && !colorspace_is_supported(desc.colorspace))
      report(desc,
             "Colour space '" + desc.colorspace + "' of image '" + desc.name +
                 "' is not known: taken as sRGB.",
             "");
    for (ImageTileDesc& tile : desc.tiles) {
      ImageLoadResult result =
          tile.pixels ? image_from_pixels(tile.pixels->data(), tile.width, tile.height,
                                          desc.is_float, desc.alpha_mode == "PREMUL", options)
                      : load_image(tile.path, options);
      tile.pixels.reset();
      if (!result.image) {
        report(desc, result.error, tile.path);
        continue;
      }
      compiler_.scene.images.push_back(result.image);
      ImageSize& size = compiler_.image_sizes[index];
      size = {std::max(size.width, result.image->width),
              std::max(size.height, result.image->height)};
      tiles.emplace(tile.number, std::move(result.image));
    }
    return tiles;
  }

  void report(const ImageDesc& desc, const std::string& text, const std::string& path) {
    compiler_.diagnostics.add({"WARNING", text, "", "", "", path.empty() ? desc.name : path});
  }

  SceneCompiler& compiler_;
  std::map<int, Tiles> images_;
  std::map<std::tuple<int, std::string, std::string>, const Texture*> textures_;
};

// Of a step, or a factor on it: neither so short that a segment has no end, nor not a number.
float usable_step(float x) {
  return x > 0.0f ? std::clamp(x, 1e-3f, 1e6f) : 1.0f;
}

// What Blender gives a surface without a material: a plain diffuse of 0.8.
NodeGraph default_graph() {
  NodeGraph graph;
  graph.name = "Default";
  graph.nodes.resize(2);
  graph.nodes[0].type = "ShaderNodeOutputMaterial";
  graph.nodes[1].type = "ShaderNodeBsdfDiffuse";
  graph.nodes[1].inputs["Color"] = {0.8f, 0.8f, 0.8f, 1.0f};
  graph.links.push_back({1, "BSDF", 0, "Surface"});
  graph.output = 0;
  return graph;
}

DisplacementMethod displacement_of(const std::string& name) {
  return name == "DISPLACEMENT" ? DisplacementMethod::displacement
         : name == "BOTH"       ? DisplacementMethod::both
                                : DisplacementMethod::bump;
}

}  // namespace

std::vector<AovPass> layout_aovs(const std::vector<AovDesc>& descriptions) {
  std::vector<AovPass> passes;
  passes.reserve(descriptions.size());
  for (const AovDesc& desc : descriptions)
    passes.push_back({desc.name, desc.is_color, aov_channels(passes)});
  return passes;
}

void SceneCompiler::compile_materials() {
  scene.aovs = layout_aovs(description.aovs);
  TextureTable textures(*this);
  const auto compile = [&](const NodeGraph& graph, ShaderDomain domain,
                           DisplacementMethod displacement) {
    CompileContext context;
    context.attributes = &attributes;
    context.aovs = &scene.aovs;
    context.texture = [&](int index, const std::string& interpolation,
                          const std::string& extension) {
      return textures.get(index, interpolation, extension);
    };
    context.grid = [&](int index) -> const VoxelGrid* {
      const auto i = static_cast<size_t>(index);
      return index >= 0 && i < scene.grids.size() ? scene.grids[i].voxels.get() : nullptr;
    };
    context.report = [&](const std::string& node, const std::string& text) {
      diagnostics.add({"WARNING", text, "", graph.name, node, ""});
    };
    Material material = compile_material({&graph, domain, displacement}, context);
    material.name = graph.name;
    scene.register_count =
        std::max({scene.register_count, material.surface.register_count(),
                  material.transparency.register_count(), material.emission.register_count(),
                  material.volume.register_count(), material.aovs.register_count()});
    if (const auto& program = material.displacement.program)
      scene.register_count = std::max(scene.register_count, program->register_count());
    return material;
  };

  const float step_rate = usable_step(description.settings.volume_step_rate);
  MaterialDesc& fallback = description.materials.emplace_back();
  fallback.name = "Default";
  fallback.graph = default_graph();
  for (const MaterialDesc& desc : description.materials) {
    if (is_cancelled()) return;
    Material material =
        compile(desc.graph, ShaderDomain::surface, displacement_of(desc.displacement_method));
    material.pass_index = desc.pass_index;
    material.use_transparent_shadow = desc.use_transparent_shadow;
    if (desc.volume_interpolation == "CUBIC") material.grid_filter = GridFilter::cubic;
    material.volume_step_rate = usable_step(desc.volume_step_rate) * step_rate;
    material.sample_as_light = desc.sample_as_light;
    scene.materials.push_back(std::move(material));
    tangents_of_material.push_back(required_tangents(desc.graph));
  }

  if (description.worlds.empty()) description.worlds.emplace_back();
  for (size_t w = 0; w < worlds_in_use(); ++w) {
    const WorldDesc& desc = world_desc(static_cast<WorldIndex>(w));
    World& world = scene.worlds[w];
    world.visibility = Visibility::from_sets(1u << w, desc.visibility.ray_kinds);
    if (desc.graph.nodes.empty()) {
      const Spectrum color{desc.color[0], desc.color[1], desc.color[2]};
      world.material.emits = !is_black(color);
      world.material.is_emission_constant = true;
      world.material.constant_emission = color;
    } else {
      world.material = compile(desc.graph, ShaderDomain::world, DisplacementMethod::bump);
    }
    world.material.name = desc.name;
    world.material.volume_step_rate = usable_step(desc.volume_step_size) * step_rate;
  }

  scene.lamp_materials.resize(description.lights.size());
  for (size_t i = 0; i < description.lights.size(); ++i) {
    const LightDesc& desc = description.lights[i];
    scene.lamp_infos.push_back({Transform::from_rows(desc.object_to_world), desc.random});
    if (!desc.graph.nodes.empty())
      scene.lamp_materials[i] = compile(desc.graph, ShaderDomain::lamp, DisplacementMethod::bump);
  }
}

}  // namespace tenniel
