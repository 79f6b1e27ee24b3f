// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/vector.h"

#include "shading/node_type.h"
#include "shading/nodes/math.h"
#include "shading/nodes/register.h"
#include "shading/surface_tangent.h"

namespace tenniel {

namespace {

using Op = VectorOperation;

Vec3 project_onto(Vec3 v, Vec3 onto) {
  const float length2 = dot(onto, onto);
  return length2 != 0.0f ? onto * (dot(v, onto) / length2) : Vec3{};
}

// GLSL's sense: `incident` runs towards the surface.
Vec3 refract_incident(Vec3 incident, Vec3 normal, float eta) {
  const float cos_i = dot(normal, incident);
  const float k = 1.0f - sqr(eta) * (1.0f - sqr(cos_i));
  return k < 0.0f ? Vec3{} : incident * eta - normal * (eta * cos_i + std::sqrt(k));
}

Vec3 geometric_operation(Op operation, Vec3 a, Vec3 b, Vec3 c, float scale) {
  switch (operation) {
    case Op::cross_product:
      return cross(a, b);
    case Op::project:
      return project_onto(a, b);
    case Op::reflect: {
      const Vec3 normal = normalize_or(b, {});
      return a - normal * (2.0f * dot(a, normal));
    }
    case Op::refract:
      return refract_incident(a, normalize_or(b, {}), scale);
    case Op::faceforward:
      return dot(c, b) < 0.0f ? a : -a;
    case Op::scale:
      return a * scale;
    case Op::normalize:
      return normalize_or(a, {});
    default:
      return {};
  }
}

}  // namespace

Vec3 vector_operation(Op operation, Vec3 a, Vec3 b, Vec3 c, float scale) {
  switch (operation) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return by_component([](float x, float y) { return safe_divide(x, y); }, a, b);
    case Op::multiply_add:
      return a * b + c;
    case Op::absolute:
      return by_component([](float x) { return std::abs(x); }, a);
    case Op::minimum:
      return by_component([](float x, float y) { return std::min(x, y); }, a, b);
    case Op::maximum:
      return by_component([](float x, float y) { return std::max(x, y); }, a, b);
    case Op::floor:
      return by_component([](float x) { return std::floor(x); }, a);
    case Op::ceil:
      return by_component([](float x) { return std::ceil(x); }, a);
    case Op::fraction:
      return by_component(fraction, a);
    case Op::modulo:
      return by_component(safe_modulo, a, b);
    case Op::wrap:
      return by_component(wrap, a, b, c);
    case Op::snap:
      return by_component(snap, a, b);
    case Op::sine:
      return by_component([](float x) { return std::sin(x); }, a);
    case Op::cosine:
      return by_component([](float x) { return std::cos(x); }, a);
    case Op::tangent:
      return by_component([](float x) { return std::tan(x); }, a);
    default:
      return geometric_operation(operation, a, b, c, scale);
  }
}

float vector_measure(Op operation, Vec3 a, Vec3 b) {
  switch (operation) {
    case Op::dot_product:
      return dot(a, b);
    case Op::distance:
      return distance(a, b);
    case Op::length:
      return length(a);
    default:
      return 0.0f;
  }
}

Transform euler_rotation(Vec3 angles) {
  const float cx = std::cos(angles.x), sx = std::sin(angles.x);
  const float cy = std::cos(angles.y), sy = std::sin(angles.y);
  const float cz = std::cos(angles.z), sz = std::sin(angles.z);
  return {{cy * cz, cy * sz, -sy},
          {sy * sx * cz - cx * sz, sy * sx * sz + cx * cz, cy * sx},
          {sy * cx * cz + sx * sz, sy * cx * sz - sx * cz, cy * cx},
          {}};
}

namespace {

struct VectorMathNode {
  Input<Vec3> a, b, c;
  Input<float> scale{1.0f};
  Output<Vec3> vector;
  Output<float> value;
  VectorOperation operation = VectorOperation::add;

  void eval(ShadingContext& context) const {
    const Vec3 x = context.get(a), y = context.get(b);
    if (vector.used())
      context.set(vector, vector_operation(operation, x, y, context.get(c), context.get(scale)));
    if (value.used()) context.set(value, vector_measure(operation, x, y));
  }
};

// Blender's Normal node: a direction dialled by hand, kept in the output socket.
struct NormalNode {
  Input<Vec3> normal{{0.0f, 0.0f, 1.0f}};
  Input<Vec3> direction{{0.0f, 0.0f, 1.0f}};
  Output<Vec3> result;
  Output<float> dot_product;

  void eval(ShadingContext& context) const {
    const Vec3 dialled = normalize_or(context.get(direction), {});
    context.set(result, dialled);
    if (dot_product.used())
      context.set(dot_product, dot(dialled, normalize_or(context.get(normal), {})));
  }
};

enum class RotationType : uint8_t { axis_angle, x_axis, y_axis, z_axis, euler_xyz };

struct VectorRotateNode {
  Input<Vec3> vector, center, axis{{0.0f, 0.0f, 1.0f}};
  Input<float> angle;
  Input<Vec3> rotation;
  Output<Vec3> result;
  RotationType rotation_type = RotationType::axis_angle;
  bool invert = false;

  Vec3 chosen_axis(const ShadingContext& context) const {
    switch (rotation_type) {
      case RotationType::x_axis:
        return {1.0f, 0.0f, 0.0f};
      case RotationType::y_axis:
        return {0.0f, 1.0f, 0.0f};
      case RotationType::z_axis:
        return {0.0f, 0.0f, 1.0f};
      default:
        return normalize_or(context.get(axis), {});
    }
  }

  void eval(ShadingContext& context) const {
    const Vec3 pivot = context.get(center), v = context.get(vector);
    if (rotation_type == RotationType::euler_xyz) {
      const Transform matrix = euler_rotation(context.get(rotation));
      const Transform used = invert ? transposed(matrix) : matrix;
      return context.set(result, used.vector(v - pivot) + pivot);
    }
    const Vec3 around = chosen_axis(context);
    if (around == Vec3{}) return context.set(result, v);
    const float turn = context.get(angle);
    context.set(result, rotate_about(v - pivot, around, invert ? -turn : turn) + pivot);
  }
};

void register_vector_math(NodeRegistry& registry) {
  registry.add<VectorMathNode>("ShaderNodeVectorMath")
      .input("Vector", &VectorMathNode::a)
      .input("Vector_001", &VectorMathNode::b)
      .input("Vector_002", &VectorMathNode::c)
      .input("Scale", &VectorMathNode::scale)
      .output("Vector", &VectorMathNode::vector)
      .output("Value", &VectorMathNode::value)
      .choice("operation", &VectorMathNode::operation,
              {{"ADD", Op::add},
               {"SUBTRACT", Op::subtract},
               {"MULTIPLY", Op::multiply},
               {"DIVIDE", Op::divide},
               {"MULTIPLY_ADD", Op::multiply_add},
               {"CROSS_PRODUCT", Op::cross_product},
               {"PROJECT", Op::project},
               {"REFLECT", Op::reflect},
               {"REFRACT", Op::refract},
               {"FACEFORWARD", Op::faceforward},
               {"DOT_PRODUCT", Op::dot_product},
               {"DISTANCE", Op::distance},
               {"LENGTH", Op::length},
               {"SCALE", Op::scale},
               {"NORMALIZE", Op::normalize},
               {"ABSOLUTE", Op::absolute},
               {"MINIMUM", Op::minimum},
               {"MAXIMUM", Op::maximum},
               {"FLOOR", Op::floor},
               {"CEIL", Op::ceil},
               {"FRACTION", Op::fraction},
               {"MODULO", Op::modulo},
               {"WRAP", Op::wrap},
               {"SNAP", Op::snap},
               {"SINE", Op::sine},
               {"COSINE", Op::cosine},
               {"TANGENT", Op::tangent}});
}

}  // namespace

void register_vector_nodes(NodeRegistry& registry) {
  register_vector_math(registry);
  registry.add<NormalNode>("ShaderNodeNormal")
      .input("Normal", &NormalNode::normal)
      .input("Direction", &NormalNode::direction)
      .output("Normal", &NormalNode::result)
      .output("Dot", &NormalNode::dot_product);
  registry.add<VectorRotateNode>("ShaderNodeVectorRotate")
      .input("Vector", &VectorRotateNode::vector)
      .input("Center", &VectorRotateNode::center)
      .input("Axis", &VectorRotateNode::axis)
      .input("Angle", &VectorRotateNode::angle)
      .input("Rotation", &VectorRotateNode::rotation)
      .output("Vector", &VectorRotateNode::result)
      .setting("invert", &VectorRotateNode::invert)
      .choice("rotation_type", &VectorRotateNode::rotation_type,
              {{"AXIS_ANGLE", RotationType::axis_angle},
               {"X_AXIS", RotationType::x_axis},
               {"Y_AXIS", RotationType::y_axis},
               {"Z_AXIS", RotationType::z_axis},
               {"EULER_XYZ", RotationType::euler_xyz}});
}

}  // namespace tenniel
