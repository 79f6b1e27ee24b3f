// SPDX-License-Identifier: Apache-2.0
#include "shading/program.h"

#include <cstdio>

#include "shading/shader_ir.h"

namespace tenniel {
namespace {

std::string number(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
  return text;
}

std::string register_name(RegisterIndex first, SocketType type) {
  std::string name("r");
  name += std::to_string(first);
  if (register_count(type) > 1)
    name.append(":").append(std::to_string(first + register_count(type) - 1));
  return name;
}

std::string shown_input(const void* node, const InputInfo& input) {
  if (const RegisterIndex from = source(node, input); from != k_no_register)
    return register_name(from, input.type);
  if (input.implicit == ImplicitInput::normal) return "normal";
  if (input.implicit == ImplicitInput::tangent) return "tangent";
  const Constant value = constant(node, input);
  if (input.type == SocketType::number) return number(value[0]);
  std::string text("(");
  text.append(number(value[0])).append(", ").append(number(value[1])).append(", ");
  return text.append(number(value[2])).append(")");
}

std::string shown_outputs(const void* node, const NodeType& type) {
  std::string text;
  for (const OutputInfo& output : type.outputs) {
    if (output.type == SocketType::closure) continue;
    const RegisterIndex to = target(node, output);
    if (to == k_no_register) continue;
    if (!text.empty()) text += ", ";
    if (type.outputs.size() > 1) text += output.identifier + " ";
    text += register_name(to, output.type);
  }
  return text.empty() ? text : text + " = ";
}

std::string shown_arguments(const void* node, const NodeType& type, const std::string& settings) {
  std::string text = settings;
  for (const InputInfo& input : type.inputs) {
    if (input.type == SocketType::closure) continue;
    if (!text.empty()) text += ", ";
    text += shown_input(node, input);
  }
  if (type.is_closure()) text += "; weight " + shown_input(node, type.closure_weight);
  return text;
}

std::string indented(const std::string& lines) {
  std::string text = "  ";
  for (size_t i = 0; i < lines.size(); ++i) {
    text += lines[i];
    if (lines[i] == '\n' && i + 1 < lines.size()) text += "  ";
  }
  return text;
}

}  // namespace

std::string Program::listing() const {
  std::string text;
  for (size_t i = 0; i < code_.size(); ++i) {
    const Instruction& step = code_[i];
    if (!step.eval) {
      text.append("skip ").append(std::to_string(step.skip)).append(" if r");
      text.append(std::to_string(step.skip_if_zero)).append(" is 0\n");
      continue;
    }
    const NodeType& type = *notes_[i].type;
    text += shown_outputs(step.node, type) + type.idname + "(" +
            shown_arguments(step.node, type, notes_[i].settings) + ")\n";
    for (const InputInfo& input : type.inputs)
      if (const Program* inner = program_of(step.node, input)) text += indented(inner->listing());
  }
  return text;
}

}  // namespace tenniel
