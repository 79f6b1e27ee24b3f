// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/math.h"

#include "shading/node_type.h"
#include "shading/nodes/register.h"

namespace tenniel {

namespace {

using Op = MathOperation;

float compare(bool condition) {
  return condition ? 1.0f : 0.0f;
}

float rounding_operation(Op operation, float a, float b, float c) {
  switch (operation) {
    case Op::round:
      return std::floor(a + 0.5f);
    case Op::floor:
      return std::floor(a);
    case Op::ceil:
      return std::ceil(a);
    case Op::trunc:
      return std::trunc(a);
    case Op::fract:
      return fraction(a);
    case Op::modulo:
      return safe_modulo(a, b);
    case Op::wrap:
      return wrap(a, b, c);
    case Op::snap:
      return snap(a, b);
    default:
      return pingpong(a, b);
  }
}

float trigonometric_operation(Op operation, float a, float b) {
  switch (operation) {
    case Op::sine:
      return std::sin(a);
    case Op::cosine:
      return std::cos(a);
    case Op::tangent:
      return std::tan(a);
    case Op::arcsine:
      return safe_asin(a);
    case Op::arccosine:
      return safe_acos(a);
    case Op::arctangent:
      return std::atan(a);
    case Op::arctan2:
      return std::atan2(a, b);
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::radians:
      return a * (k_pi / 180.0f);
    default:
      return a * (180.0f / k_pi);
  }
}

float comparison_operation(Op operation, float a, float b, float c) {
  switch (operation) {
    case Op::minimum:
      return std::min(a, b);
    case Op::maximum:
      return std::max(a, b);
    case Op::less_than:
      return compare(a < b);
    case Op::greater_than:
      return compare(a > b);
    case Op::sign:
      return compare(a > 0.0f) - compare(a < 0.0f);
    case Op::compare:
      return compare(a == b || std::abs(a - b) <= std::max(c, FLT_EPSILON));
    case Op::smooth_min:
      return smooth_minimum(a, b, c);
    default:
      return -smooth_minimum(-a, -b, c);
  }
}

}  // namespace

float math_operation(Op operation, float a, float b, float c) {
  switch (operation) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return safe_divide(a, b);
    case Op::multiply_add:
      return a * b + c;
    case Op::power:
      return safe_power(a, b);
    case Op::logarithm:
      return safe_logarithm(a, b);
    case Op::sqrt:
      return safe_sqrt(a);
    case Op::inverse_sqrt:
      return a > 0.0f ? 1.0f / std::sqrt(a) : 0.0f;
    case Op::absolute:
      return std::abs(a);
    case Op::exponent:
      return std::exp(a);
    default:
      break;
  }
  if (operation <= Op::smooth_max) return comparison_operation(operation, a, b, c);
  if (operation <= Op::pingpong) return rounding_operation(operation, a, b, c);
  return trigonometric_operation(operation, a, b);
}

float shape_range(MapRangeShape shape, float x, float steps) {
  switch (shape) {
    case MapRangeShape::linear:
      return x;
    case MapRangeShape::stepped:
      return steps > 0.0f ? std::floor(x * (steps + 1.0f)) / steps : 0.0f;
    case MapRangeShape::smoothstep:
      return smoothstep(saturate(x));
    case MapRangeShape::smootherstep: {
      const float t = saturate(x);
      return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    }
  }
  return x;
}

namespace {

struct MathNode {
  Input<float> a{0.5f}, b{0.5f}, c{0.5f};
  Output<float> value;
  MathOperation operation = MathOperation::add;
  bool use_clamp = false;

  void eval(ShadingContext& context) const {
    const float result = math_operation(operation, context.get(a), context.get(b), context.get(c));
    context.set(value, use_clamp ? saturate(result) : result);
  }
};

enum class ClampType : uint8_t { minmax, range };

struct ClampNode {
  Input<float> value{1.0f}, low{0.0f}, high{1.0f};
  Output<float> result;
  ClampType clamp_type = ClampType::minmax;

  void eval(ShadingContext& context) const {
    const float x = context.get(value), a = context.get(low), b = context.get(high);
    context.set(result,
                clamp_type == ClampType::minmax ? clamp_minmax(x, a, b) : clamp_range(x, a, b));
  }
};

enum class MapRangeType : uint8_t { number, vector };

struct MapRangeNode {
  Input<float> value{1.0f}, from_min{0.0f}, from_max{1.0f}, to_min{0.0f}, to_max{1.0f}, steps{4.0f};
  Input<Vec3> vector;
  Input<Vec3> from_min_v, from_max_v{{1.0f, 1.0f, 1.0f}};
  Input<Vec3> to_min_v, to_max_v{{1.0f, 1.0f, 1.0f}};
  Input<Vec3> steps_v{{4.0f, 4.0f, 4.0f}};
  Output<float> result;
  Output<Vec3> result_v;
  bool clamp = true;
  MapRangeShape shape = MapRangeShape::linear;
  MapRangeType data_type = MapRangeType::number;

  float map(float position, float start, float end, float step_count) const {
    const float mapped = start + shape_range(shape, position, step_count) * (end - start);
    return clamp ? clamp_range(mapped, start, end) : mapped;
  }

  void eval(ShadingContext& context) const {
    if (data_type == MapRangeType::vector) return eval_vector(context);
    const float a = context.get(from_min), b = context.get(from_max);
    const float start = context.get(to_min), end = context.get(to_max);
    // An empty source range gives 0 here, but the start of the target for vectors.
    if (a == b) return context.set(result, clamp ? clamp_range(0.0f, start, end) : 0.0f);
    context.set(result, map((context.get(value) - a) / (b - a), start, end, context.get(steps)));
  }

  void eval_vector(ShadingContext& context) const {
    const Vec3 x = context.get(vector), a = context.get(from_min_v), b = context.get(from_max_v);
    const Vec3 start = context.get(to_min_v), end = context.get(to_max_v);
    const Vec3 step_count = context.get(steps_v);
    Vec3 mapped;
    for (int i = 0; i < 3; ++i)
      mapped[i] = map(safe_divide(x[i] - a[i], b[i] - a[i]), start[i], end[i], step_count[i]);
    context.set(result_v, mapped);
  }
};

void register_math(NodeRegistry& registry) {
  registry.add<MathNode>("ShaderNodeMath")
      .input("Value", &MathNode::a)
      .input("Value_001", &MathNode::b)
      .input("Value_002", &MathNode::c)
      .output("Value", &MathNode::value)
      .setting("use_clamp", &MathNode::use_clamp)
      .choice("operation", &MathNode::operation,
              {{"ADD", Op::add},
               {"SUBTRACT", Op::subtract},
               {"MULTIPLY", Op::multiply},
               {"DIVIDE", Op::divide},
               {"MULTIPLY_ADD", Op::multiply_add},
               {"POWER", Op::power},
               {"LOGARITHM", Op::logarithm},
               {"SQRT", Op::sqrt},
               {"INVERSE_SQRT", Op::inverse_sqrt},
               {"ABSOLUTE", Op::absolute},
               {"EXPONENT", Op::exponent},
               {"MINIMUM", Op::minimum},
               {"MAXIMUM", Op::maximum},
               {"LESS_THAN", Op::less_than},
               {"GREATER_THAN", Op::greater_than},
               {"SIGN", Op::sign},
               {"COMPARE", Op::compare},
               {"SMOOTH_MIN", Op::smooth_min},
               {"SMOOTH_MAX", Op::smooth_max},
               {"ROUND", Op::round},
               {"FLOOR", Op::floor},
               {"CEIL", Op::ceil},
               {"TRUNC", Op::trunc},
               {"FRACT", Op::fract},
               {"MODULO", Op::modulo},
               {"WRAP", Op::wrap},
               {"SNAP", Op::snap},
               {"PINGPONG", Op::pingpong},
               {"SINE", Op::sine},
               {"COSINE", Op::cosine},
               {"TANGENT", Op::tangent},
               {"ARCSINE", Op::arcsine},
               {"ARCCOSINE", Op::arccosine},
               {"ARCTANGENT", Op::arctangent},
               {"ARCTAN2", Op::arctan2},
               {"SINH", Op::sinh},
               {"COSH", Op::cosh},
               {"TANH", Op::tanh},
               {"RADIANS", Op::radians},
               {"DEGREES", Op::degrees}});
}

void register_map_range(NodeRegistry& registry) {
  registry.add<MapRangeNode>("ShaderNodeMapRange")
      .input("Value", &MapRangeNode::value)
      .input("From Min", &MapRangeNode::from_min)
      .input("From Max", &MapRangeNode::from_max)
      .input("To Min", &MapRangeNode::to_min)
      .input("To Max", &MapRangeNode::to_max)
      .input("Steps", &MapRangeNode::steps)
      .input("Vector", &MapRangeNode::vector)
      .input("From_Min_FLOAT3", &MapRangeNode::from_min_v)
      .input("From_Max_FLOAT3", &MapRangeNode::from_max_v)
      .input("To_Min_FLOAT3", &MapRangeNode::to_min_v)
      .input("To_Max_FLOAT3", &MapRangeNode::to_max_v)
      .input("Steps_FLOAT3", &MapRangeNode::steps_v)
      .output("Result", &MapRangeNode::result)
      .output("Vector", &MapRangeNode::result_v)
      .setting("clamp", &MapRangeNode::clamp)
      .choice("interpolation_type", &MapRangeNode::shape,
              {{"LINEAR", MapRangeShape::linear},
               {"STEPPED", MapRangeShape::stepped},
               {"SMOOTHSTEP", MapRangeShape::smoothstep},
               {"SMOOTHERSTEP", MapRangeShape::smootherstep}})
      .choice("data_type", &MapRangeNode::data_type,
              {{"FLOAT", MapRangeType::number}, {"FLOAT_VECTOR", MapRangeType::vector}});
}

}  // namespace

void register_math_nodes(NodeRegistry& registry) {
  register_math(registry);
  registry.add<ClampNode>("ShaderNodeClamp")
      .input("Value", &ClampNode::value)
      .input("Min", &ClampNode::low)
      .input("Max", &ClampNode::high)
      .output("Result", &ClampNode::result)
      .choice("clamp_type", &ClampNode::clamp_type,
              {{"MINMAX", ClampType::minmax}, {"RANGE", ClampType::range}});
  register_map_range(registry);
}

}  // namespace tenniel
