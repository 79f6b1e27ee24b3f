// SPDX-License-Identifier: Apache-2.0
#include "shading/compiler_passes.h"
#include "shading/internal_nodes.h"

namespace tenniel {
namespace {

const NodeRegistry& registry_of(const CompileContext& context) {
  return context.registry ? *context.registry : node_registry();
}

size_t input_index(const NodeType& type, std::string_view identifier) {
  size_t i = 0;
  while (i < type.inputs.size() && type.inputs[i].identifier != identifier)
    ++i;
  return i;
}

SocketType output_type(const ShaderIr& ir, IrLink link) {
  return ir.at(link.node).type->outputs[static_cast<size_t>(link.output)].type;
}

// A number becomes the strength of a white emission, all else its colour; as Cycles does.
IrLink emission_of(ShaderIr& ir, IrLink value, const CompileContext& context) {
  const NodeType* type = registry_of(context).find("ShaderNodeEmission");
  if (!type) return {};
  const bool is_number = output_type(ir, value) == SocketType::number;
  const std::string name = ir.at(value.node).name;
  const int emission = ir.add(*type);
  ir.at(emission).name = name;
  ir.link(emission, input_index(*type, is_number ? "Strength" : "Color"), value);
  return {emission, 0};
}

IrLink converted(ShaderIr& ir, IrLink value, SocketType to, const CompileContext& context) {
  const SocketType from = output_type(ir, value);
  if (from == to) return value;
  if (to == SocketType::closure) return emission_of(ir, value, context);
  if (from == SocketType::closure) {
    report(context, ir.at(value.node).name,
           "a shader cannot be linked to a value; the link is cut");
    return {};
  }
  const std::string name = ir.at(value.node).name;
  const int conversion = ir.add(conversion_node(from, to));
  ir.at(conversion).name = name;
  ir.link(conversion, 0, value);
  return {conversion, 0};
}

// One shared node of `idname` whose output `output` feeds every input that implies it.
class ImplicitSource {
 public:
  ImplicitSource(const char* idname, const char* output) : idname_(idname), output_(output) {}

  IrLink get(ShaderIr& ir, const CompileContext& context) {
    if (tried_) return link_;
    tried_ = true;
    const NodeType* type = registry_of(context).find(idname_);
    const OutputInfo* output = type ? type->output(output_) : nullptr;
    if (!output) return link_;
    link_ = {ir.add(*type), static_cast<int>(output - type->outputs.data())};
    GraphNode unset;
    unset.name = idname_;
    ir.at(link_.node).name = idname_;
    apply_settings(ir.at(link_.node), unset, context);
    return link_;
  }

 private:
  const char* idname_;
  const char* output_;
  bool tried_ = false;
  IrLink link_;
};

}  // namespace

void insert_conversions(ShaderIr& ir, const CompileContext& context) {
  // Nodes that a conversion adds are appended, and their own links are checked in turn.
  for (size_t n = 0; n < ir.nodes.size(); ++n) {
    for (size_t i = 0; i < ir.nodes[n].links.size(); ++i) {
      const IrLink link = ir.nodes[n].links[i];
      if (!link.linked()) continue;
      const SocketType to = input_info(*ir.nodes[n].type, i).type;
      const IrLink fitting = converted(ir, link, to, context);
      if (fitting != link) ir.link(static_cast<int>(n), i, fitting);
    }
  }
}

void insert_implicit_inputs(ShaderIr& ir, const CompileContext& context) {
  ImplicitSource generated("ShaderNodeTexCoord", "Generated");
  ImplicitSource uv("ShaderNodeTexCoord", "UV");
  ImplicitSource object_normal("ShaderNodeTexCoord", "Normal");
  // Position is the direction in a World.
  ImplicitSource direction("ShaderNodeNewGeometry", "Position");
  for (size_t n = 0, count = ir.nodes.size(); n < count; ++n) {
    const NodeType& type = *ir.nodes[n].type;
    for (size_t i = 0; i < type.inputs.size(); ++i) {
      if (ir.nodes[n].links[i].linked()) continue;
      IrLink source;
      switch (type.inputs[i].implicit) {
        case ImplicitInput::generated:
          source = generated.get(ir, context);
          break;
        case ImplicitInput::uv:
          source = uv.get(ir, context);
          break;
        case ImplicitInput::direction:
          source = direction.get(ir, context);
          break;
        case ImplicitInput::object_normal:
          source = object_normal.get(ir, context);
          break;
        default:
          break;
      }
      if (source.linked()) ir.link(static_cast<int>(n), i, source);
    }
  }
}

void insert_displacement(ShaderIr& ir, const MaterialSource& source) {
  if (ir.output < 0 || source.domain != ShaderDomain::surface) return;
  const size_t input = input_index(*ir.at(ir.output).type, "Displacement");
  if (input == ir.at(ir.output).type->inputs.size()) return;
  const IrLink displacement = ir.at(ir.output).links[input];
  if (!displacement.linked()) return;
  ir.prologue = ir.add(displacement_bump_node(source.displacement == DisplacementMethod::both));
  ir.at(ir.prologue).name = ir.at(ir.output).name;
  ir.link(ir.prologue, 0, displacement);
}

}  // namespace tenniel
