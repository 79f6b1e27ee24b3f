// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"
#include "shading/node_type.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

using Rgba = Texture::Rgba;

// `straight`: colour divided by alpha.
Rgba read_image(const ImageSlot& slot, Vec2 uv, bool straight) {
  return slot.texture ? slot.texture->lookup(uv, straight) : k_missing_image;
}

enum class Projection : uint8_t { flat, box, sphere, tube };

struct ImageTextureNode {
  Input<Vec3> vector;
  Output<Spectrum> color;
  Output<float> alpha;
  ImageSlot image;
  std::vector<float> texture_mapping;
  Projection projection = Projection::flat;
  float projection_blend = 0.0f;
  // Colour is straight where the tree uses Alpha, also in programs that were compiled without it.
  bool alpha_is_linked = false;
  Interpolation interpolation = Interpolation::linear;  // in effect through `image.texture`
  Extension extension = Extension::repeat;              // likewise

  void eval(ShadingContext& context) const {
    const Vec3 p = apply_texture_mapping(texture_mapping, context.get(vector));
    const Rgba rgba = projection == Projection::box ? read_box(context, p)
                                                    : read_image(image, project(p), is_straight());
    context.set(color, {rgba[0], rgba[1], rgba[2]});
    context.set(alpha, rgba[3]);
  }

  bool is_straight() const { return alpha_is_linked || alpha.used(); }

  Vec2 project(Vec3 p) const {
    switch (projection) {
      case Projection::sphere:
        return sphere_projection(p);
      case Projection::tube:
        return tube_projection(p);
      default:
        return {p.x, p.y};
    }
  }

  Rgba read_box(const ShadingContext& context, Vec3 p) const {
    Vec3 normal = context.surface.shading_normal;
    if (context.surface.instance)
      normal = context.surface.object_to_world().transposed_vector(normal);
    const Vec3 weights = box_weights(normal, projection_blend);
    Rgba sum{};
    for (int axis = 0; axis < 3; ++axis) {
      if (weights[axis] <= 0.0f) continue;
      const Rgba face = read_image(image, box_projection(p, normal, axis), is_straight());
      for (size_t c = 0; c < 4; ++c)
        sum[c] += weights[axis] * face[c];
    }
    return sum;
  }
};

enum class EnvironmentProjection : uint8_t { equirectangular, mirror_ball };

struct EnvironmentTextureNode {
  Input<Vec3> vector;
  Output<Spectrum> color;
  ImageSlot image;
  std::vector<float> texture_mapping;
  EnvironmentProjection projection = EnvironmentProjection::equirectangular;
  Interpolation interpolation = Interpolation::linear;  // in effect through `image.texture`

  void eval(ShadingContext& context) const {
    const Vec3 direction = apply_texture_mapping(texture_mapping, context.get(vector));
    const Vec2 uv = projection == EnvironmentProjection::mirror_ball
                        ? mirror_ball_projection(direction)
                        : equirectangular_projection(direction);
    const Rgba rgba = read_image(image, uv, false);
    context.set(color, {rgba[0], rgba[1], rgba[2]});
  }
};

}  // namespace

void register_image_nodes(NodeRegistry& registry) {
  // On the CPU Cycles takes Smart for Cubic, and so do we.
  const auto interpolations = {
      std::pair{"Linear", Interpolation::linear}, std::pair{"Closest", Interpolation::closest},
      std::pair{"Cubic", Interpolation::cubic}, std::pair{"Smart", Interpolation::cubic}};
  registry.add<ImageTextureNode>("ShaderNodeTexImage")
      .input("Vector", &ImageTextureNode::vector)
      .implicit(ImplicitInput::uv)
      .output("Color", &ImageTextureNode::color)
      .output("Alpha", &ImageTextureNode::alpha)
      .setting("image", &ImageTextureNode::image)
      .setting("texture_mapping", &ImageTextureNode::texture_mapping)
      .choice("projection", &ImageTextureNode::projection,
              {{"FLAT", Projection::flat},
               {"BOX", Projection::box},
               {"SPHERE", Projection::sphere},
               {"TUBE", Projection::tube}})
      .setting("projection_blend", &ImageTextureNode::projection_blend)
      .setting("alpha_is_linked", &ImageTextureNode::alpha_is_linked)
      .choice("interpolation", &ImageTextureNode::interpolation, interpolations)
      .choice(
          "extension", &ImageTextureNode::extension,
          {{"REPEAT", Extension::repeat}, {"EXTEND", Extension::extend}, {"CLIP", Extension::clip}})
      .varying();
  registry.add<EnvironmentTextureNode>("ShaderNodeTexEnvironment")
      .input("Vector", &EnvironmentTextureNode::vector)
      .implicit(ImplicitInput::direction)
      .output("Color", &EnvironmentTextureNode::color)
      .setting("image", &EnvironmentTextureNode::image)
      .setting("texture_mapping", &EnvironmentTextureNode::texture_mapping)
      .choice("projection", &EnvironmentTextureNode::projection,
              {{"EQUIRECTANGULAR", EnvironmentProjection::equirectangular},
               {"MIRROR_BALL", EnvironmentProjection::mirror_ball}})
      .choice("interpolation", &EnvironmentTextureNode::interpolation, interpolations)
      .varying();
}

}  // namespace tenniel
