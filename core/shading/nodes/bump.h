// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/frame.h"
#include "shading/node_type.h"
#include "shading/program.h"

// Nodes that bend the shading normal: Bump, Normal Map, and the two displacement nodes, whose
// vector moves vertices (scene/displace.h), acts as bump, or both.
namespace tenniel {

// Heights at a point and at the two points `step_x`, `step_y` (world space) away from it.
struct BumpSample {
  Vec3 step_x, step_y;
  float height = 0.0f, height_x = 0.0f, height_y = 0.0f;
};

// Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU": `normal` (unit) tilted against
// the gradient of the heights. `scale` multiplies heights; `strength` mixes with `normal`.
Vec3 bump_normal(const BumpSample& sample, Vec3 normal, float scale, float strength);

// The two directions along the surface that Blender differentiates in; z is `normal`.
Frame differential_frame(Vec3 normal);

struct BumpNode {
  Input<float> strength{1.0f}, distance{1.0f};
  ProgramInput<float> height;
  Input<Vec3> normal;
  bool invert = false;
  Output<Vec3> result;
  void eval(ShadingContext& context) const;

 private:
  BumpSample sample(ShadingContext& context) const;
};

enum class NormalMapSpace : uint8_t { tangent, object, world, blender_object, blender_world };

struct NormalMapNode {
  Input<float> strength{1.0f};
  Input<Spectrum> color{{0.5f, 0.5f, 1.0f}};
  NormalMapSpace space = NormalMapSpace::tangent;
  AttributeSlot tangent, tangent_sign;
  Output<Vec3> result;
  void eval(ShadingContext& context) const;

 private:
  // In world space as on a front face; empty (zero) where the mesh lacks what it takes.
  Vec3 mapped(const SurfaceInteraction& surface, Vec3 encoded) const;
};

enum class DisplacementSpace : uint8_t { tangent, object, world };

// The displacement in world space.
struct DisplacementNode {
  Input<float> height{0.0f}, midlevel{0.5f}, scale{1.0f};
  Input<Vec3> normal;
  DisplacementSpace space = DisplacementSpace::object;
  Output<Vec3> result;
  void eval(ShadingContext& context) const;
};

struct VectorDisplacementNode {
  Input<Spectrum> vector;
  Input<float> midlevel{0.0f}, scale{1.0f};
  DisplacementSpace space = DisplacementSpace::tangent;
  AttributeSlot tangent, tangent_sign;
  Output<Vec3> result;
  void eval(ShadingContext& context) const;

 private:
  Vec3 from_tangent_space(const ShadingContext& context, Vec3 move) const;  // to object space
};

// What is linked to Displacement of Material Output, as bump of the whole surface. Placed by the
// compiler only.
struct DisplacementBumpNode {
  ProgramInput<Vec3> displacement;
  void eval(ShadingContext& context) const;
};

// The same where true displacement has moved the surface already (BOTH), as Blender 3.4 does it:
// the normal tilts in object space, and what shifts positions and what shifts attributes are steps
// of different length on relief.
struct DisplacedBumpNode {
  ProgramInput<Vec3> displacement;
  void eval(ShadingContext& context) const;
};

}  // namespace tenniel
