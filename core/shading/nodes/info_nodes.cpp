// SPDX-License-Identifier: Apache-2.0
// Nodes that tell what an object was made of: particles, strands, points, wires.
#include <array>

#include "math/hash.h"
#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/nodes/attributes.h"
#include "shading/nodes/bump.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

// Of the particle that this instance stands for; nothing but zeros elsewhere.
struct ParticleInfoNode {
  Output<float> index, random, age, lifetime, size;
  Output<Vec3> location, velocity, angular_velocity;
  AttributeSlot numbers{k_particle_numbers}, place{k_particle_location};
  AttributeSlot speed{k_particle_velocity}, turn{k_particle_angular_velocity};

  void eval(ShadingContext& context) const {
    const auto n = instance_attribute(context, numbers.id).value_or(std::array<float, 4>{});
    context.set(index, n[0]);
    context.set(random, uint_to_unit_closed(hash_uint(static_cast<uint32_t>(n[0]), 0)));
    context.set(age, n[1]);
    context.set(lifetime, n[2]);
    context.set(size, n[3]);
    set(context, location, place);
    set(context, velocity, speed);
    set(context, angular_velocity, turn);
  }
  static void set(ShadingContext& context, const Output<Vec3>& output, const AttributeSlot& slot) {
    if (!output.used()) return;
    const auto v = instance_attribute(context, slot.id).value_or(std::array<float, 4>{});
    context.set(output, {v[0], v[1], v[2]});
  }
};

// Of the hair that was hit; a surface has none: zeros, as in Blender.
struct HairInfoNode {
  Output<float> is_strand, intercept, length, thickness, random;
  Output<Vec3> tangent_normal;
  AttributeSlot intercepts{k_strand_intercept}, lengths{k_strand_length};
  AttributeSlot randoms{k_strand_random};

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& at = context.surface;
    const bool is_hair = is_on_hair(at);
    const auto number = [&](const Output<float>& output, const AttributeSlot& slot) {
      const auto value = is_hair ? mesh_attribute(context, slot.id) : std::nullopt;
      context.set(output, value ? (*value)[0] : 0.0f);
    };
    context.set(is_strand, is_hair ? 1.0f : 0.0f);
    number(intercept, intercepts);
    number(length, lengths);
    number(random, randoms);
    context.set(thickness, strand_thickness(at));
    context.set(tangent_normal, is_hair ? across_hair(at) : Vec3{});
  }

  // To the viewer, square to the hair.
  static Vec3 across_hair(const SurfaceInteraction& at) {
    const Vec3 along = normalize_or(strand_direction(at), {});
    return normalize_or(at.wo - along * dot(along, at.wo), {});
  }
};

struct PointInfoNode {
  Output<Vec3> position;
  Output<float> radius, random;
  AttributeSlot randoms{k_strand_random};

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& at = context.surface;
    const bool is_point = is_on_sphere(at);
    context.set(position, is_point ? sphere_center(at) : Vec3{});
    context.set(radius, is_point ? sphere_radius(at) : 0.0f);
    const auto value = is_point ? mesh_attribute(context, randoms.id) : std::nullopt;
    context.set(random, value ? (*value)[0] : 0.0f);
  }
};

// 1 within half the size of an edge of the triangle that was hit.
struct WireframeNode {
  Input<float> size{0.01f};
  Output<float> factor;
  bool use_pixel_size = false;

  void eval(ShadingContext& context) const {
    const SurfaceInteraction& at = context.surface;
    if (!at.mesh) return context.set(factor, 0.0f);
    float half_width = 0.5f * context.get(size);
    if (use_pixel_size) half_width *= pixel_width(at);
    float is_near = 0.0f;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3 edge = at.corner_points[(i + 1) % 3] - at.corner_points[i];
      const Vec3 off = cross(edge, at.position - at.corner_points[i]);
      if (length_squared(off) < length_squared(edge) * half_width * half_width) is_near = 1.0f;
    }
    context.set(factor, is_near);
  }

  // A pixel on the surface as the viewer sees it: the mean of its two sides.
  static float pixel_width(const SurfaceInteraction& at) {
    const Frame frame = differential_frame(at.geometric_normal);
    const auto seen = [&](Vec3 side) { return length(side - at.wo * dot(side, at.wo)); };
    return 2.0f * at.footprint * 0.5f * (seen(frame.x) + seen(frame.y));
  }
};

}  // namespace

void register_info_nodes(NodeRegistry& registry) {
  registry.add<ParticleInfoNode>("ShaderNodeParticleInfo")
      .output("Index", &ParticleInfoNode::index)
      .output("Random", &ParticleInfoNode::random)
      .output("Age", &ParticleInfoNode::age)
      .output("Lifetime", &ParticleInfoNode::lifetime)
      .output("Location", &ParticleInfoNode::location)
      .output("Size", &ParticleInfoNode::size)
      .output("Velocity", &ParticleInfoNode::velocity)
      .output("Angular Velocity", &ParticleInfoNode::angular_velocity)
      .setting("numbers", &ParticleInfoNode::numbers)
      .setting("place", &ParticleInfoNode::place)
      .setting("speed", &ParticleInfoNode::speed)
      .setting("turn", &ParticleInfoNode::turn)
      .varying();
  registry.add<HairInfoNode>("ShaderNodeHairInfo")
      .output("Is Strand", &HairInfoNode::is_strand)
      .output("Intercept", &HairInfoNode::intercept)
      .output("Length", &HairInfoNode::length)
      .output("Thickness", &HairInfoNode::thickness)
      .output("Tangent Normal", &HairInfoNode::tangent_normal)
      .output("Random", &HairInfoNode::random)
      .setting("intercepts", &HairInfoNode::intercepts)
      .setting("lengths", &HairInfoNode::lengths)
      .setting("randoms", &HairInfoNode::randoms)
      .varying();
  registry.add<PointInfoNode>("ShaderNodePointInfo")
      .output("Position", &PointInfoNode::position)
      .output("Radius", &PointInfoNode::radius)
      .output("Random", &PointInfoNode::random)
      .setting("randoms", &PointInfoNode::randoms)
      .varying();
  registry.add<WireframeNode>("ShaderNodeWireframe")
      .input("Size", &WireframeNode::size)
      .output("Fac", &WireframeNode::factor)
      .setting("use_pixel_size", &WireframeNode::use_pixel_size)
      .varying();
}

}  // namespace tenniel
