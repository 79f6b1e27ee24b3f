// SPDX-License-Identifier: Apache-2.0
#include "shading/shader_ir.h"

#include <new>
#include <utility>

#include "shading/program.h"

namespace tenniel {
namespace {

template <class T>
T& member(void* node, size_t offset) {
  return *reinterpret_cast<T*>(static_cast<char*>(node) + offset);
}

// Calls `f` with the Input<T>& (or const) that `input` describes. A ProgramInput starts with its
// Input, so both are reached alike.
template <class F>
auto visit_input(void* node, const InputInfo& input, F f) {
  switch (input.type) {
    case SocketType::vector:
      return f(member<Input<Vec3>>(node, input.offset));
    case SocketType::color:
      return f(member<Input<Spectrum>>(node, input.offset));
    default:
      return f(member<Input<float>>(node, input.offset));
  }
}
static_assert(offsetof(ProgramInput<float>, result) == 0);

template <class F>
auto visit_program(void* node, const InputInfo& input, F f) {
  switch (input.type) {
    case SocketType::vector:
      return f(member<ProgramInput<Vec3>>(node, input.offset));
    case SocketType::color:
      return f(member<ProgramInput<Spectrum>>(node, input.offset));
    default:
      return f(member<ProgramInput<float>>(node, input.offset));
  }
}

Constant to_constant(float v) {
  return {v, 0.0f, 0.0f};
}
Constant to_constant(Vec3 v) {
  return {v.x, v.y, v.z};
}
Constant to_constant(Spectrum v) {
  return {v.r, v.g, v.b};
}

void* allocate(const NodeType& type) {
  return ::operator new (type.size, std::align_val_t{type.alignment});
}

}  // namespace

NodeData::NodeData(const NodeType& type) : type_(&type), storage_(allocate(type)) {
  type.construct(storage_);
}

NodeData::NodeData(NodeData&& other) noexcept
    : type_(other.type_), storage_(std::exchange(other.storage_, nullptr)) {}

NodeData& NodeData::operator=(NodeData&& other) noexcept {
  std::swap(type_, other.type_);
  std::swap(storage_, other.storage_);
  return *this;
}

NodeData::~NodeData() {
  if (!storage_) return;
  type_->destroy(storage_);
  ::operator delete (storage_, std::align_val_t{type_->alignment});
}

IrNode::IrNode(const NodeType& node_type)
    : type(&node_type), data(node_type), links(input_count(node_type)) {}

int ShaderIr::add(const NodeType& type) {
  nodes.emplace_back(type);
  return static_cast<int>(nodes.size()) - 1;
}

void ShaderIr::link(int node, size_t input, IrLink from) {
  IrNode& to = at(node);
  to.links[input] = from;
  const InputInfo& info = input_info(*to.type, input);
  if (info.type != SocketType::closure)
    set_source(to.data.get(), info, from.linked() ? 0 : k_no_register);
}

int ShaderIr::common_region(int a, int b) const {
  const auto region = [this](int i) -> const IrRegion& { return regions[static_cast<size_t>(i)]; };
  while (a != b) {
    if (region(a).depth < region(b).depth) std::swap(a, b);
    a = region(a).parent;
  }
  return a;
}

size_t input_count(const NodeType& type) {
  return type.inputs.size() + (type.is_closure() ? 1 : 0);
}

const InputInfo& input_info(const NodeType& type, size_t input) {
  return input < type.inputs.size() ? type.inputs[input] : type.closure_weight;
}

Constant constant(const void* node, const InputInfo& input) {
  return visit_input(const_cast<void*>(node), input,
                     [](const auto& member) { return to_constant(member.value); });
}

void set_constant(void* node, const InputInfo& input, const Constant& value) {
  visit_input(node, input, [&value](auto& member) {
    if constexpr (std::is_same_v<decltype(member.value), float>)
      member.value = value[0];
    else
      member.value = {value[0], value[1], value[2]};
  });
}

RegisterIndex source(const void* node, const InputInfo& input) {
  return visit_input(const_cast<void*>(node), input,
                     [](const auto& member) { return member.source; });
}

void set_source(void* node, const InputInfo& input, RegisterIndex source) {
  visit_input(node, input, [source](auto& member) { member.source = source; });
}

void set_program(void* node, const InputInfo& input, std::shared_ptr<const Program> program,
                 RegisterIndex here) {
  visit_program(node, input, [&](auto& member) {
    member.program = std::move(program);
    member.here.source = here;
  });
}

const Program* program_of(const void* node, const InputInfo& input) {
  if (!input.is_program) return nullptr;
  return visit_program(const_cast<void*>(node), input,
                       [](const auto& member) { return member.program.get(); });
}

// The register is the only member of Output<T>.
RegisterIndex target(const void* node, const OutputInfo& output) {
  return member<RegisterIndex>(const_cast<void*>(node), output.offset);
}

void set_target(void* node, const OutputInfo& output, RegisterIndex target) {
  member<RegisterIndex>(node, output.offset) = target;
}

std::vector<int> topological_order(const ShaderIr& ir, const std::vector<int>& roots,
                                   const InputFilter& follows) {
  struct Visit {
    int node;
    size_t next_input;
  };
  std::vector<int> order;
  std::vector<bool> seen(ir.nodes.size(), false);
  std::vector<Visit> stack;
  const auto enter = [&](int node) {
    if (node < 0 || seen[static_cast<size_t>(node)]) return;
    seen[static_cast<size_t>(node)] = true;
    stack.push_back({node, 0});
  };
  for (int root : roots) {
    enter(root);
    while (!stack.empty()) {
      Visit& top = stack.back();
      const IrNode& node = ir.at(top.node);
      if (top.next_input == node.links.size()) {
        order.push_back(top.node);
        stack.pop_back();
        continue;
      }
      const size_t input = top.next_input++;
      if (node.links[input].linked() && follows(node, input)) enter(node.links[input].node);
    }
  }
  return order;
}

std::vector<int> topological_order(const ShaderIr& ir, const std::vector<int>& roots) {
  return topological_order(ir, roots, [](const IrNode&, size_t) { return true; });
}

std::vector<int> program_roots(const ShaderIr& ir) {
  std::vector<int> roots;
  if (ir.prologue >= 0) roots.push_back(ir.prologue);
  for (const IrClosure& closure : ir.closures)
    roots.push_back(closure.node);
  return roots;
}

}  // namespace tenniel
