// SPDX-License-Identifier: Apache-2.0
#include "bsdf/fresnel.h"
#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/nodes/attributes.h"
#include "shading/nodes/layer_weight.h"
#include "shading/nodes/register.h"
#include "shading/surface_tangent.h"

namespace tenniel {

namespace {

// Blender keeps the value of these two in the output socket.
struct RgbNode {
  Input<Spectrum> value{Spectrum(0.5f)};
  Output<Spectrum> color;
  void eval(ShadingContext& context) const { context.set(color, context.get(value)); }
};

struct ValueNode {
  Input<float> value{0.5f};
  Output<float> result;
  void eval(ShadingContext& context) const { context.set(result, context.get(value)); }
};

struct GeometryNode {
  Output<Vec3> position, normal, tangent, true_normal, incoming, parametric;
  Output<float> back_facing, pointiness, random_per_island;
  AttributeSlot island{k_random_per_island}, vertex_pointiness{k_pointiness};

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& surface = context.surface;
    context.set(position, surface.position);
    context.set(normal, surface.shading_normal);
    if (tangent.used()) context.set(tangent, tangent_of(surface));
    context.set(true_normal, surface.geometric_normal);
    context.set(incoming, surface.wo);
    if (parametric.used()) context.set(parametric, parametric_of(surface));
    context.set(back_facing, surface.is_back_facing ? 1.0f : 0.0f);
    if (pointiness.used()) {
      const auto value = mesh_attribute(context, vertex_pointiness.id);
      context.set(pointiness, value ? (*value)[0] : 0.0f);
    }
    if (random_per_island.used()) {
      const auto value = mesh_attribute(context, island.id);
      context.set(random_per_island, value ? (*value)[0] : 0.0f);
    }
  }

  static Vec3 tangent_of(const SurfaceInteraction& surface) {
    if (is_on_hair(surface)) return normalize_or(strand_direction(surface), {});
    return surface.mesh ? surface_tangent(surface, surface.shading_normal) : Vec3{};
  }

  static Vec3 parametric_of(const SurfaceInteraction& surface) {
    const Vec2 weights = surface.mesh ? parametric_coordinates(surface)
                                      : Vec2{1.0f - surface.u - surface.v, surface.u};
    return {weights.x, weights.y, 0.0f};
  }
};

struct ObjectInfoNode {
  Output<Vec3> location;
  Output<Spectrum> color;
  Output<float> alpha, object_index, material_index, random;

  void eval(ShadingContext& context) const {
    context.set(material_index, context.material_pass_index);
    const Instance* instance = context.surface.instance;
    context.set(location, instance ? instance->object_to_world.translation : Vec3{});
    const Vec3 tint = instance ? instance->color : Vec3{};
    context.set(color, {tint.x, tint.y, tint.z});
    context.set(alpha, instance ? instance->alpha : 0.0f);
    context.set(object_index, instance ? instance->pass_index : 0.0f);
    context.set(random, instance ? instance->random : context.lamp ? context.lamp->random : 0.0f);
  }
};

enum class TangentType : uint8_t { radial, uv_map };
enum class TangentAxis : uint8_t { x, y, z };

struct TangentNode {
  Output<Vec3> tangent;
  TangentType direction_type = TangentType::radial;
  TangentAxis axis = TangentAxis::z;
  AttributeSlot map;  // tangents built from the UV map

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& surface = context.surface;
    const Vec3 along = object_direction(context);
    const Vec3 world = surface.instance ? normal_to_world(surface, along) : along;
    const Vec3 n = surface.shading_normal;
    context.set(tangent, cross(n, normalize_or(cross(world, n), {})));
  }

  Vec3 object_direction(const ShadingContext& context) const {
    if (direction_type == TangentType::uv_map) {
      const auto found = mesh_attribute(context, map.id);
      return found ? Vec3{(*found)[0], (*found)[1], (*found)[2]} : Vec3{};
    }
    const Vec3 g = generated_coordinates(context.surface) - Vec3{0.5f, 0.5f, 0.5f};
    if (axis == TangentAxis::x) return {0.0f, -g.z, g.y};
    if (axis == TangentAxis::y) return {-g.z, 0.0f, g.x};
    return {-g.y, g.x, 0.0f};
  }
};

// A shadow ray is none of the kinds of the path it belongs to, only itself; light that is sampled
// is met by no ray of any kind.
struct LightPathNode {
  Output<float> is_camera, is_shadow, is_diffuse, is_glossy, is_singular, is_reflection;
  Output<float> is_transmission, ray_length, ray_depth, diffuse_depth, glossy_depth;
  Output<float> transparent_depth, transmission_depth;

  void eval(ShadingContext& context) const {
    const PathInfo& path = context.path;
    const bool has_ray = !path.is_light_sample;
    const auto flag = [&](const Output<float>& output, bool condition) {
      context.set(output, has_ray && condition ? 1.0f : 0.0f);
    };
    const bool shadow = path.kind == RayKind::shadow;
    const bool transmitted = path.kind == RayKind::transmission;
    flag(is_camera, path.kind == RayKind::camera);
    flag(is_shadow, shadow);
    flag(is_diffuse, path.is_diffuse && !shadow);
    // Glass counts as glossy for what it lets through, too.
    flag(is_glossy, !path.is_diffuse && (path.kind == RayKind::glossy || transmitted));
    flag(is_singular, path.is_singular && !shadow);
    flag(is_reflection, path.is_reflection && !shadow);
    flag(is_transmission, transmitted);
    context.set(ray_length, context.surface.t);
    // The vertex that a shadow ray was sent from counts as a bounce.
    context.set(ray_depth, static_cast<float>(path.ray_depth + (shadow ? 1 : 0)));
    context.set(diffuse_depth, static_cast<float>(path.diffuse_depth));
    context.set(glossy_depth, static_cast<float>(path.glossy_depth));
    context.set(transparent_depth, static_cast<float>(path.transparent_depth));
    context.set(transmission_depth, static_cast<float>(path.transmission_depth));
  }
};

struct FresnelNode {
  Input<float> ior{1.45f};
  Input<Vec3> normal;
  Output<float> factor;

  void eval(ShadingContext& context) const {
    const float inside_over_outside = std::max(context.get(ior), 1e-5f);
    const float eta =
        context.surface.is_back_facing ? 1.0f / inside_over_outside : inside_over_outside;
    context.set(factor, fresnel_dielectric(dot(context.surface.wo, context.normal(normal)), eta));
  }
};

struct LayerWeightNode {
  Input<float> blend{0.5f};
  Input<Vec3> normal;
  Output<float> fresnel, facing;

  void eval(ShadingContext& context) const {
    const float mixed = context.get(blend);
    const float cos_theta = dot(context.surface.wo, context.normal(normal));
    if (fresnel.used())
      context.set(fresnel, layer_fresnel(cos_theta, mixed, context.surface.is_back_facing));
    if (facing.used()) context.set(facing, layer_facing(cos_theta, mixed));
  }
};

// Camera space as shaders see it: z points forward.
struct CameraDataNode {
  Output<Vec3> view_vector;
  Output<float> z_depth, distance_to_camera;

  void eval(ShadingContext& context) const {
    if (!context.camera) return;
    Vec3 p = context.camera->world_to_camera.point(context.surface.position);
    p.z = -p.z;
    context.set(view_vector, normalize_or(p, {}));
    context.set(z_depth, p.z);
    context.set(distance_to_camera, length(p));
  }
};

void register_geometry(NodeRegistry& registry) {
  registry.add<GeometryNode>("ShaderNodeNewGeometry")
      .output("Position", &GeometryNode::position)
      .output("Normal", &GeometryNode::normal)
      .output("Tangent", &GeometryNode::tangent)
      .output("True Normal", &GeometryNode::true_normal)
      .output("Incoming", &GeometryNode::incoming)
      .output("Parametric", &GeometryNode::parametric)
      .output("Backfacing", &GeometryNode::back_facing)
      .output("Pointiness", &GeometryNode::pointiness)
      .output("Random Per Island", &GeometryNode::random_per_island)
      .setting("island", &GeometryNode::island)
      .setting("vertex_pointiness", &GeometryNode::vertex_pointiness)
      .varying();
  registry.add<ObjectInfoNode>("ShaderNodeObjectInfo")
      .output("Location", &ObjectInfoNode::location)
      .output("Color", &ObjectInfoNode::color)
      .output("Alpha", &ObjectInfoNode::alpha)
      .output("Object Index", &ObjectInfoNode::object_index)
      .output("Material Index", &ObjectInfoNode::material_index)
      .output("Random", &ObjectInfoNode::random)
      .varying();
  registry.add<TangentNode>("ShaderNodeTangent")
      .output("Tangent", &TangentNode::tangent)
      .choice("direction_type", &TangentNode::direction_type,
              {{"RADIAL", TangentType::radial}, {"UV_MAP", TangentType::uv_map}})
      .choice("axis", &TangentNode::axis,
              {{"X", TangentAxis::x}, {"Y", TangentAxis::y}, {"Z", TangentAxis::z}})
      .setting("uv_map", &TangentNode::map, ".tangent")
      .varying();
}

void register_path_and_view(NodeRegistry& registry) {
  registry.add<LightPathNode>("ShaderNodeLightPath")
      .output("Is Camera Ray", &LightPathNode::is_camera)
      .output("Is Shadow Ray", &LightPathNode::is_shadow)
      .output("Is Diffuse Ray", &LightPathNode::is_diffuse)
      .output("Is Glossy Ray", &LightPathNode::is_glossy)
      .output("Is Singular Ray", &LightPathNode::is_singular)
      .output("Is Reflection Ray", &LightPathNode::is_reflection)
      .output("Is Transmission Ray", &LightPathNode::is_transmission)
      .output("Ray Length", &LightPathNode::ray_length)
      .output("Ray Depth", &LightPathNode::ray_depth)
      .output("Diffuse Depth", &LightPathNode::diffuse_depth)
      .output("Glossy Depth", &LightPathNode::glossy_depth)
      .output("Transparent Depth", &LightPathNode::transparent_depth)
      .output("Transmission Depth", &LightPathNode::transmission_depth)
      .varying();
  registry.add<FresnelNode>("ShaderNodeFresnel")
      .input("IOR", &FresnelNode::ior)
      .input("Normal", &FresnelNode::normal)
      .implicit(ImplicitInput::normal)
      .output("Fac", &FresnelNode::factor)
      .varying();
  registry.add<LayerWeightNode>("ShaderNodeLayerWeight")
      .input("Blend", &LayerWeightNode::blend)
      .input("Normal", &LayerWeightNode::normal)
      .implicit(ImplicitInput::normal)
      .output("Fresnel", &LayerWeightNode::fresnel)
      .output("Facing", &LayerWeightNode::facing)
      .varying();
  registry.add<CameraDataNode>("ShaderNodeCameraData")
      .output("View Vector", &CameraDataNode::view_vector)
      .output("View Z Depth", &CameraDataNode::z_depth)
      .output("View Distance", &CameraDataNode::distance_to_camera)
      .varying();
}

}  // namespace

void register_input_nodes(NodeRegistry& registry) {
  registry.add<RgbNode>("ShaderNodeRGB")
      .input("Color", &RgbNode::value)
      .output("Color", &RgbNode::color);
  registry.add<ValueNode>("ShaderNodeValue")
      .input("Value", &ValueNode::value)
      .output("Value", &ValueNode::result);
  register_geometry(registry);
  register_path_and_view(registry);
  register_attribute_nodes(registry);
}

}  // namespace tenniel
