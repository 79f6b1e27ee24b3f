// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/bump.h"

#include <algorithm>
#include <cmath>

#include "bsdf/shading_normal.h"
#include "math/frame.h"
#include "math/numeric.h"
#include "shading/nodes/register.h"

namespace tenniel {

// Where a height curves, a finite difference shows its directions: these are Blender's.
Frame differential_frame(Vec3 normal) {
  const Vec3 diagonal = std::abs(normal.x - normal.y) + std::abs(normal.x - normal.z) > 0.0f
                            ? Vec3{1.0f, 1.0f, 1.0f}
                            : Vec3{-1.0f, 1.0f, 1.0f};
  return Frame::from_normal_tangent(normal, cross(diagonal, normal));
}

namespace {

// Distance of the shifted points: the width of a pixel, and never so little that the heights of
// neighbours cannot be told apart.
float bump_step(const SurfaceInteraction& surface) {
  const Vec3 p = surface.position;
  const float extent = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1.0f});
  return std::max(2.0f * surface.footprint, 1e-5f * extent);
}

// Where heights are taken beside a point: `step_x` and `step_y` are perpendicular to its normal.
struct BumpSteps {
  Vec3 step_x, step_y;
};

BumpSteps steps_beside(const SurfaceInteraction& here) {
  const Frame frame = differential_frame(here.geometric_normal);
  const float step = bump_step(here);
  return {frame.x * step, frame.y * step};
}

// The height that `program` leaves at `place`; `read` takes it from the context. Moves the surface.
template <class Read>
float height_at(ShadingContext& context, const SurfaceInteraction& place, const Program& program,
                Read read) {
  context.surface = place;
  program.run(context);
  return read(context);
}

// The point and the two beside it at which a displacement is taken as a height.
struct BumpPlaces {
  SurfaceInteraction here, x, y;
  Vec3 step_x, step_y;
};

BumpPlaces places_beside(const SurfaceInteraction& here) {
  const auto [step_x, step_y] = steps_beside(here);
  return {here, shifted(here, step_x), shifted(here, step_y), step_x, step_y};
}

// Blender keeps one length for all directions, on the displaced surface as on the old one: seen
// from attributes, which move with the surface, that of the old one is not the length of the step.
BumpPlaces undisplaced_places(const SurfaceInteraction& here) {
  BumpPlaces places = places_beside(here);
  const Vec3 origin = undisplaced_position(here);
  const float length_x = length(undisplaced_position(places.x) - origin);
  const float length_y = length(undisplaced_position(places.y) - origin);
  const Frame frame = differential_frame(here.geometric_normal);
  places.step_x = frame.x * (0.5f * (length_x + length_y));
  places.step_y = frame.y * (0.5f * (length_x + length_y));
  places.here.position = origin;
  places.x.position = origin + places.step_x;
  places.y.position = origin + places.step_y;
  return places;
}

BumpSample sample_displacement(ShadingContext& context, const BumpPlaces& places,
                               const ProgramInput<Vec3>& displacement) {
  const SurfaceInteraction kept = context.surface;
  const auto height = [&](const SurfaceInteraction& place) {
    return height_at(context, place, *displacement.program, [&](const ShadingContext& c) {
      return dot(c.get(displacement.result), c.closure_normal);
    });
  };
  BumpSample sample{places.step_x, places.step_y};
  sample.height_x = height(places.x);
  sample.height_y = height(places.y);
  sample.height = height(places.here);
  context.surface = kept;
  return sample;
}

Vec3 raised(const SurfaceInteraction& surface, Vec3 normal) {
  return ensure_valid_reflection(surface.geometric_normal, surface.wo, normal);
}

// A vector of object space that must turn as the normal does, back in object space.
Vec3 object_normal(const SurfaceInteraction& surface, Vec3 normal) {
  return normalize_or(surface.object_to_world().transposed_vector(normal), normal);
}

}  // namespace

Vec3 bump_normal(const BumpSample& sample, Vec3 normal, float scale, float strength) {
  const Vec3 row_x = cross(sample.step_y, normal), row_y = cross(normal, sample.step_x);
  const float det = dot(sample.step_x, row_x);
  const Vec3 gradient =
      (sample.height_x - sample.height) * row_x + (sample.height_y - sample.height) * row_y;
  const Vec3 tilted =
      normalize_or(std::abs(det) * normal - (det < 0.0f ? -scale : scale) * gradient, normal);
  return normalize_or(strength * tilted + (1.0f - strength) * normal, normal);
}

BumpSample BumpNode::sample(ShadingContext& context) const {
  const SurfaceInteraction here = context.surface;
  const auto [step_x, step_y] = steps_beside(here);
  const auto beside = [&](Vec3 step) {
    return height_at(context, shifted(here, step), *height.program,
                     [this](const ShadingContext& c) { return c.get(height.result); });
  };
  const float height_x = beside(step_x), height_y = beside(step_y);
  context.surface = here;
  return {step_x, step_y, context.get(height.here), height_x, height_y};
}

void BumpNode::eval(ShadingContext& context) const {
  const Vec3 base = context.normal(normal);
  if (!height.program || !context.surface.mesh) return context.set(result, base);
  const float scale = context.get(distance) * (invert ? -1.0f : 1.0f);
  const Vec3 bent =
      bump_normal(sample(context), base, scale, std::max(context.get(strength), 0.0f));
  context.set(result, raised(context.surface, bent));
}

Vec3 NormalMapNode::mapped(const SurfaceInteraction& surface, Vec3 encoded) const {
  if (space == NormalMapSpace::tangent) {
    const Attribute* along_u = surface.mesh->attribute(tangent.id);
    const Attribute* sign = surface.mesh->attribute(tangent_sign.id);
    if (!along_u || !sign) return {};
    const auto t = interpolate(*along_u, surface);
    const Vec3 smooth = interpolated_object_normal(surface), x_axis{t[0], t[1], t[2]};
    const Vec3 y_axis = cross(smooth, x_axis) * interpolate(*sign, surface)[0];
    return normal_to_world(surface, encoded.x * x_axis + encoded.y * y_axis + encoded.z * smooth);
  }
  const bool is_blender =
      space == NormalMapSpace::blender_object || space == NormalMapSpace::blender_world;
  if (is_blender) encoded = {encoded.x, -encoded.y, -encoded.z};
  const bool is_object = space == NormalMapSpace::object || space == NormalMapSpace::blender_object;
  return is_object ? normal_to_world(surface, encoded) : encoded;
}

void NormalMapNode::eval(ShadingContext& context) const {
  const SurfaceInteraction& surface = context.surface;
  const Vec3 base = context.closure_normal;
  if (!surface.mesh || !surface.instance) return context.set(result, base);
  const Spectrum c = context.get(color);
  const Vec3 encoded{2.0f * c.r - 1.0f, 2.0f * c.g - 1.0f, 2.0f * c.b - 1.0f};
  const Vec3 front = mapped(surface, encoded);
  Vec3 bent = normalize_or(surface.is_back_facing ? -front : front, base);
  const float amount = std::max(context.get(strength), 0.0f);
  if (amount != 1.0f) bent = normalize_or(base + (bent - base) * amount, base);
  context.set(result, bent);
}

void DisplacementNode::eval(ShadingContext& context) const {
  const float amount = (context.get(height) - context.get(midlevel)) * context.get(scale);
  Vec3 along = context.normal(normal);
  if (space == DisplacementSpace::object && context.surface.instance)
    along = context.surface.object_to_world().vector(object_normal(context.surface, along));
  context.set(result, along * amount);
}

// y is the height; x runs along u of the active UV map, without one along the first edge.
Vec3 VectorDisplacementNode::from_tangent_space(const ShadingContext& context, Vec3 move) const {
  const SurfaceInteraction& surface = context.surface;
  const Vec3 up = object_normal(surface, context.closure_normal);
  const Attribute* along_u = surface.mesh ? surface.mesh->attribute(tangent.id) : nullptr;
  const Attribute* sign = surface.mesh ? surface.mesh->attribute(tangent_sign.id) : nullptr;
  Vec3 along;
  float side = 1.0f;
  if (along_u && sign) {
    const auto t = interpolate(*along_u, surface);
    along = {t[0], t[1], t[2]};
    side = interpolate(*sign, surface)[0];
  } else if (surface.mesh) {
    along =
        normalize_or(surface.world_to_object().vector(-parametric_v_direction(surface)), Vec3());
  }
  const Vec3 across = normalize_or(cross(up, along), Vec3()) * side;
  return along * move.x + up * move.y + across * move.z;
}

void VectorDisplacementNode::eval(ShadingContext& context) const {
  const Spectrum c = context.get(vector);
  const float middle = context.get(midlevel);
  Vec3 move = Vec3{c.r - middle, c.g - middle, c.b - middle} * context.get(scale);
  const Instance* instance = context.surface.instance;
  if (space == DisplacementSpace::tangent && instance) move = from_tangent_space(context, move);
  if (space != DisplacementSpace::world && instance)
    move = context.surface.object_to_world().vector(move);
  context.set(result, move);
}

void DisplacementBumpNode::eval(ShadingContext& context) const {
  if (!displacement.program || !context.surface.mesh) return;
  const BumpSample sample =
      sample_displacement(context, places_beside(context.surface), displacement);
  const Vec3 bent = bump_normal(sample, context.closure_normal, 1.0f, 1.0f);
  context.bend_shading_normal(raised(context.surface, bent));
}

void DisplacedBumpNode::eval(ShadingContext& context) const {
  const SurfaceInteraction& surface = context.surface;
  if (!displacement.program || !surface.mesh || !surface.instance) return;
  BumpSample sample = sample_displacement(context, undisplaced_places(surface), displacement);
  const Transform to_object = surface.world_to_object();
  sample.step_x = to_object.vector(sample.step_x);
  sample.step_y = to_object.vector(sample.step_y);
  const Vec3 normal = object_normal(surface, context.closure_normal);
  const Vec3 bent = normal_to_world(surface, bump_normal(sample, normal, 1.0f, 1.0f));
  context.bend_shading_normal(raised(surface, bent));
}

void register_bump_nodes(NodeRegistry& registry) {
  registry.add<BumpNode>("ShaderNodeBump")
      .input("Strength", &BumpNode::strength)
      .input("Distance", &BumpNode::distance)
      .input("Height", &BumpNode::height)
      .read_here()
      .input("Normal", &BumpNode::normal)
      .implicit(ImplicitInput::normal)
      .setting("invert", &BumpNode::invert)
      .output("Normal", &BumpNode::result)
      .varying();
  registry.add<NormalMapNode>("ShaderNodeNormalMap")
      .input("Strength", &NormalMapNode::strength)
      .input("Color", &NormalMapNode::color)
      .choice("space", &NormalMapNode::space,
              {{"TANGENT", NormalMapSpace::tangent},
               {"OBJECT", NormalMapSpace::object},
               {"WORLD", NormalMapSpace::world},
               {"BLENDER_OBJECT", NormalMapSpace::blender_object},
               {"BLENDER_WORLD", NormalMapSpace::blender_world}})
      .setting("uv_map", &NormalMapNode::tangent, ".tangent")
      .setting("uv_map", &NormalMapNode::tangent_sign, ".tangent.sign")
      .output("Normal", &NormalMapNode::result)
      .varying();
  registry.add<DisplacementNode>("ShaderNodeDisplacement")
      .input("Height", &DisplacementNode::height)
      .input("Midlevel", &DisplacementNode::midlevel)
      .input("Scale", &DisplacementNode::scale)
      .input("Normal", &DisplacementNode::normal)
      .implicit(ImplicitInput::normal)
      .choice("space", &DisplacementNode::space,
              {{"OBJECT", DisplacementSpace::object}, {"WORLD", DisplacementSpace::world}})
      .output("Displacement", &DisplacementNode::result)
      .varying();
  registry.add<VectorDisplacementNode>("ShaderNodeVectorDisplacement")
      .input("Vector", &VectorDisplacementNode::vector)
      .input("Midlevel", &VectorDisplacementNode::midlevel)
      .input("Scale", &VectorDisplacementNode::scale)
      .choice("space", &VectorDisplacementNode::space,
              {{"TANGENT", DisplacementSpace::tangent},
               {"OBJECT", DisplacementSpace::object},
               {"WORLD", DisplacementSpace::world}})
      .setting("uv_map", &VectorDisplacementNode::tangent, ".tangent")
      .setting("uv_map", &VectorDisplacementNode::tangent_sign, ".tangent.sign")
      .output("Displacement", &VectorDisplacementNode::result)
      .varying();
}

}  // namespace tenniel
