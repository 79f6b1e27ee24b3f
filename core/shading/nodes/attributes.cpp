// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/attributes.h"

#include "image/voxel_grid.h"
#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/nodes/vector.h"

namespace tenniel {

std::optional<std::array<float, 4>> mesh_attribute(const ShadingContext& context, int id) {
  const Mesh* mesh = context.surface.mesh;
  const Attribute* attribute = mesh ? mesh->attribute(id) : nullptr;
  if (!attribute) return std::nullopt;
  std::array<float, 4> value = interpolate(*attribute, context.surface);
  if (attribute->channels == 1) value[1] = value[2] = value[0];
  return value;
}

std::optional<std::array<float, 4>> instance_attribute(const ShadingContext& context, int id) {
  const Instance* instance = context.surface.instance;
  if (!instance) return std::nullopt;
  for (const auto& [attribute, value] : instance->object_attributes)
    if (attribute == id) return value;
  return std::nullopt;
}

std::optional<std::array<float, 4>> grid_attribute(const Instance& instance, Vec3 point, float time,
                                                   int id, GridFilter filter) {
  for (const PlacedGrid& grid : instance.grids) {
    if (grid.attribute != id) continue;
    const Vec3 p = instance.motion.empty()
                       ? grid.from_world.point(point)
                       : grid.from_object.point(instance.world_to_object_at(time).point(point));
    std::array<float, 4> value = grid.voxels->lookup(p, filter);
    const float alpha = value[3];
    if (alpha > 1e-6f && alpha != 1.0f)
      for (size_t c = 0; c < 3; ++c)
        value[c] /= alpha;
    return value;
  }
  return std::nullopt;
}

std::optional<std::array<float, 4>> grid_attribute(const ShadingContext& context, int id) {
  const SurfaceInteraction& at = context.surface;
  if (at.mesh || !at.instance) return std::nullopt;
  return grid_attribute(*at.instance, at.position, at.time, id, context.grid_filter);
}

Vec3 uv_attribute(const ShadingContext& context, int id) {
  const auto value = mesh_attribute(context, id);
  return value ? Vec3{(*value)[0], (*value)[1], 0.0f} : Vec3{};
}

Vec3 texture_space_coordinate(const Instance& instance, Vec3 point) {
  const Vec3 from = point - instance.texture_space_location;
  const auto scaled = [](float x, float size) { return safe_divide(x, 2.0f * size) + 0.5f; };
  return by_component(scaled, from, instance.texture_space_size);
}

Vec3 instancer_uv(const ShadingContext& context) {
  const Instance* instance = context.surface.instance;
  return instance ? Vec3{instance->instancer_uv.x, instance->instancer_uv.y, 0.0f} : Vec3{};
}

namespace {

using Rgba = std::array<float, 4>;

enum class AttributeType : uint8_t { geometry, object, instancer, view_layer };

// The magic mirror's own attributes, which every tree may read.
std::optional<float> mirror_attribute(const std::string& name, WorldIndex world) {
  if (name == k_behind_mirror) return world == 0 ? 0.0f : 1.0f;
  if (name == k_dream) return static_cast<float>(world);
  return std::nullopt;
}

struct AttributeNode {
  Output<Spectrum> color;
  Output<Vec3> vector;
  Output<float> factor, alpha;
  AttributeType type = AttributeType::geometry;
  AttributeSlot attribute;

  // What is missing is black; on the mesh it is opaque, on the object it is not.
  Rgba value(const ShadingContext& context) const {
    if (const auto mirror = mirror_attribute(attribute.name, context.path.world))
      return {*mirror, *mirror, *mirror, 1.0f};
    if (type == AttributeType::geometry) {
      if (const auto voxel = grid_attribute(context, attribute.id)) return *voxel;
      return mesh_attribute(context, attribute.id).value_or(Rgba{0.0f, 0.0f, 0.0f, 1.0f});
    }
    return instance_attribute(context, attribute.id).value_or(Rgba{});
  }

  // The mean, but of one number itself to the last bit, and of two (a UV) the first.
  float factor_of(const ShadingContext& context, const Rgba& v) const {
    const Mesh* mesh = context.surface.mesh;
    const Attribute* data =
        mesh && type == AttributeType::geometry ? mesh->attribute(attribute.id) : nullptr;
    return data && data->channels <= 2 ? v[0] : (v[0] + v[1] + v[2]) * (1.0f / 3.0f);
  }

  void eval(ShadingContext& context) const {
    const Rgba v = value(context);
    context.set(color, {v[0], v[1], v[2]});
    context.set(vector, {v[0], v[1], v[2]});
    if (factor.used()) context.set(factor, factor_of(context, v));
    context.set(alpha, v[3]);
  }
};

struct ColorAttributeNode {
  Output<Spectrum> color;
  Output<float> alpha;
  AttributeSlot layer{k_active_color};

  void eval(ShadingContext& context) const {
    const Rgba v = mesh_attribute(context, layer.id).value_or(Rgba{});
    context.set(color, {v[0], v[1], v[2]});
    context.set(alpha, v[3]);
  }
};

struct UvMapNode {
  Output<Vec3> uv;
  AttributeSlot map;
  bool from_instancer = false;

  void eval(ShadingContext& context) const {
    context.set(uv, from_instancer ? instancer_uv(context) : uv_attribute(context, map.id));
  }
};

}  // namespace

void register_attribute_nodes(NodeRegistry& registry) {
  registry.add<AttributeNode>("ShaderNodeAttribute")
      .output("Color", &AttributeNode::color)
      .output("Vector", &AttributeNode::vector)
      .output("Fac", &AttributeNode::factor)
      .output("Alpha", &AttributeNode::alpha)
      .choice("attribute_type", &AttributeNode::type,
              {{"GEOMETRY", AttributeType::geometry},
               {"OBJECT", AttributeType::object},
               {"INSTANCER", AttributeType::instancer},
               {"VIEW_LAYER", AttributeType::view_layer}})
      .setting("attribute_name", &AttributeNode::attribute)
      .varying();
  registry.add<ColorAttributeNode>("ShaderNodeVertexColor")
      .output("Color", &ColorAttributeNode::color)
      .output("Alpha", &ColorAttributeNode::alpha)
      .setting("layer_name", &ColorAttributeNode::layer)
      .varying();
  registry.add<UvMapNode>("ShaderNodeUVMap")
      .output("UV", &UvMapNode::uv)
      .setting("uv_map", &UvMapNode::map)
      .setting("from_instancer", &UvMapNode::from_instancer)
      .varying();
}

}  // namespace tenniel
