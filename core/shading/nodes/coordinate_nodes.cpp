// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/nodes/attributes.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/register.h"
#include "shading/nodes/vector.h"
#include "shading/surface_tangent.h"

namespace tenniel {

namespace {

// Shaders see camera space with z forward, Blender's cameras look along -z.
constexpr Vec3 flip_z(Vec3 v) {
  return {v.x, v.y, -v.z};
}

// World to object, from an object-space normal's sight: n_object = M^T n_world with M the map of
// points from object to world.
Vec3 normal_to_object(const ShadingContext& context, Vec3 normal) {
  if (!context.surface.instance && !context.lamp) return normal;
  const Transform map =
      context.surface.instance ? context.surface.object_to_world() : context.lamp->object_to_world;
  return normalize_or(map.transposed_vector(normal), normal);
}

struct TextureCoordinateNode {
  Output<Vec3> generated, normal, uv, object, camera, window, reflection;
  bool from_instancer = false;
  std::vector<float> object_transform;  // 12: rows of the world-to-object map of `object`
  AttributeSlot active_uv{k_active_uv}, undeformed{k_undeformed};

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& surface = context.surface;
    if (generated.used()) context.set(generated, generated_of(context));
    if (normal.used()) context.set(normal, normal_of(context));
    if (uv.used())
      context.set(uv, from_instancer ? instancer_uv(context) : uv_attribute(context, active_uv.id));
    if (object.used()) context.set(object, object_of(context));
    if (camera.used()) context.set(camera, camera_of(context));
    if (window.used()) context.set(window, window_of(context));
    if (reflection.used())
      context.set(reflection,
                  surface.instance ? reflect(surface.wo, surface.shading_normal) : surface.wo);
  }

  Vec3 generated_of(const ShadingContext& context) const {
    const Instance* instance = context.surface.instance;
    if (from_instancer) return instance ? instance->generated : Vec3{};
    if (const auto p = mesh_attribute(context, undeformed.id); p && instance)
      return texture_space_coordinate(*instance, {(*p)[0], (*p)[1], (*p)[2]});
    return generated_coordinates(context.surface);
  }

  static Vec3 normal_of(const ShadingContext& context) {
    if (context.domain == ShaderDomain::world) return context.surface.wo;
    return normal_to_object(context, context.surface.shading_normal);
  }

  Vec3 object_of(const ShadingContext& context) const {
    const Vec3 p = context.surface.position;
    if (object_transform.size() >= 12) {
      std::array<float, 12> rows;
      std::copy_n(object_transform.begin(), 12, rows.begin());
      return Transform::from_rows(rows).point(p);
    }
    return context.surface.instance ? context.surface.world_to_object().point(p) : p;
  }

  static Vec3 camera_of(const ShadingContext& context) {
    if (!context.camera) return {};
    const Transform& map = context.camera->world_to_camera;
    const Vec3 p = context.surface.position;
    // What is no object counts from the camera.
    return flip_z(context.domain == ShaderDomain::surface ? map.point(p) : map.vector(p));
  }

  static Vec3 window_of(const ShadingContext& context) {
    if (!context.camera || !context.camera->window) return {};
    Vec3 p = context.surface.position;
    // A World lies in a direction: any point that the camera sees there will do.
    if (context.domain == ShaderDomain::world)
      p = context.camera->world_to_camera.inverse().translation + p;
    const Vec2 at = context.camera->window(context.camera->camera, p);
    return {at.x, at.y, 0.0f};
  }
};

struct MappingNode {
  Input<Vec3> vector, location, rotation, scale{{1.0f, 1.0f, 1.0f}};
  Output<Vec3> result;
  MappingType vector_type = MappingType::point;
  std::optional<Transform> turn;  // of a rotation without a link: its sines cost more than the rest

  void settle() {
    if (!rotation.linked()) turn = euler_rotation(rotation.value);
  }
  void eval(ShadingContext& context) const {
    context.set(result, map_vector(vector_type, context.get(vector), context.get(location),
                                   turn ? *turn : euler_rotation(context.get(rotation)),
                                   context.get(scale)));
  }
};

enum class Space : uint8_t { world, object, camera };
enum class TransformedAs : uint8_t { point, vector, normal };

struct VectorTransformNode {
  Input<Vec3> vector{{0.5f, 0.5f, 0.5f}};
  Output<Vec3> result;
  TransformedAs vector_type = TransformedAs::vector;
  Space convert_from = Space::world, convert_to = Space::object;

  void eval(ShadingContext& context) const {
    Vec3 v = context.get(vector);
    if (convert_from != convert_to) v = from_world(context, to_world(context, v));
    context.set(result, vector_type == TransformedAs::normal ? normalize_or(v, {}) : v);
  }

  // `map` carries points, `inverse` is its inverse.
  Vec3 apply(const Transform& map, const Transform& inverse, Vec3 v) const {
    if (vector_type == TransformedAs::point) return map.point(v);
    if (vector_type == TransformedAs::vector) return map.vector(v);
    return inverse.transposed_vector(v);
  }

  Vec3 to_world(const ShadingContext& context, Vec3 v) const {
    const SurfaceInteraction& surface = context.surface;
    if (convert_from == Space::object && surface.instance)
      return apply(surface.object_to_world(), surface.world_to_object(), v);
    if (convert_from == Space::camera && context.camera) {
      const Transform& map = context.camera->world_to_camera;
      return apply(map.inverse(), map, flip_z(v));
    }
    return v;
  }

  Vec3 from_world(const ShadingContext& context, Vec3 v) const {
    const SurfaceInteraction& surface = context.surface;
    if (convert_to == Space::object && surface.instance)
      return apply(surface.world_to_object(), surface.object_to_world(), v);
    if (convert_to == Space::camera && context.camera) {
      const Transform& map = context.camera->world_to_camera;
      return flip_z(apply(map, map.inverse(), v));
    }
    return v;
  }
};

}  // namespace

void register_coordinate_nodes(NodeRegistry& registry) {
  registry.add<TextureCoordinateNode>("ShaderNodeTexCoord")
      .output("Generated", &TextureCoordinateNode::generated)
      .output("Normal", &TextureCoordinateNode::normal)
      .output("UV", &TextureCoordinateNode::uv)
      .output("Object", &TextureCoordinateNode::object)
      .output("Camera", &TextureCoordinateNode::camera)
      .output("Window", &TextureCoordinateNode::window)
      .output("Reflection", &TextureCoordinateNode::reflection)
      .setting("from_instancer", &TextureCoordinateNode::from_instancer)
      .setting("object_transform", &TextureCoordinateNode::object_transform)
      .setting("active_uv", &TextureCoordinateNode::active_uv)
      .setting("undeformed", &TextureCoordinateNode::undeformed)
      .varying();
  registry.add<MappingNode>("ShaderNodeMapping")
      .input("Vector", &MappingNode::vector)
      .input("Location", &MappingNode::location)
      .input("Rotation", &MappingNode::rotation)
      .input("Scale", &MappingNode::scale)
      .output("Vector", &MappingNode::result)
      .choice("vector_type", &MappingNode::vector_type,
              {{"POINT", MappingType::point},
               {"TEXTURE", MappingType::texture},
               {"VECTOR", MappingType::vector},
               {"NORMAL", MappingType::normal}});
  registry.add<VectorTransformNode>("ShaderNodeVectorTransform")
      .input("Vector", &VectorTransformNode::vector)
      .output("Vector", &VectorTransformNode::result)
      .choice("vector_type", &VectorTransformNode::vector_type,
              {{"POINT", TransformedAs::point},
               {"VECTOR", TransformedAs::vector},
               {"NORMAL", TransformedAs::normal}})
      .choice("convert_from", &VectorTransformNode::convert_from,
              {{"WORLD", Space::world}, {"OBJECT", Space::object}, {"CAMERA", Space::camera}})
      .choice("convert_to", &VectorTransformNode::convert_to,
              {{"WORLD", Space::world}, {"OBJECT", Space::object}, {"CAMERA", Space::camera}})
      .varying();
}

}  // namespace tenniel
