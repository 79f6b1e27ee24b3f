// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "shading/compiler_passes.h"
#include "shading/node_arena.h"
#include "shading/program.h"

namespace tenniel {
namespace {

// Registers of every output, by a linear scan: a value holds its place from the step that makes it
// to the last one that reads it. Jumps only go forward, so the order of steps bounds every path.
class RegisterAllocation {
 public:
  RegisterAllocation(const ShaderIr& ir, const std::vector<ProgramStep>& steps, uint8_t query,
                     RegisterIndex base)
      : ir_(ir), steps_(steps), query_(query), end_(base), values_(ir.nodes.size()) {}

  void run(IrLink result) {
    for (size_t s = 0; s < steps_.size(); ++s)
      for (IrLink link : reads(steps_[s]))
        value(link).last_use = static_cast<int>(s);
    if (result.linked()) value(result).last_use = static_cast<int>(steps_.size());
    for (size_t s = 0; s < steps_.size(); ++s) {
      // Outputs first: a node may write one before it has read every input.
      if (steps_[s].node >= 0) place_outputs(steps_[s].node);
      for (IrLink link : reads(steps_[s]))
        release(link, static_cast<int>(s));
    }
  }

  RegisterIndex at(IrLink link) const {
    const auto& outputs = values_[static_cast<size_t>(link.node)];
    const auto i = static_cast<size_t>(link.output);
    return i < outputs.size() ? outputs[i].place : k_no_register;
  }
  RegisterIndex end() const { return end_; }

 private:
  struct Value {
    int last_use = -1;
    RegisterIndex place = k_no_register;
    bool released = false;
  };

  std::vector<IrLink> reads(const ProgramStep& step) const {
    if (step.node < 0) return {step.guard};
    std::vector<IrLink> links;
    const IrNode& node = ir_.at(step.node);
    for (size_t i = 0; i < node.links.size(); ++i)
      if (node.links[i].linked() && is_read(node, i, query_)) links.push_back(node.links[i]);
    return links;
  }

  Value& value(IrLink link) {
    auto& outputs = values_[static_cast<size_t>(link.node)];
    if (outputs.empty()) outputs.resize(ir_.at(link.node).type->outputs.size());
    return outputs[static_cast<size_t>(link.output)];
  }

  int size_of(int node, size_t output) const {
    return register_count(ir_.at(node).type->outputs[output].type);
  }

  void place_outputs(int node) {
    auto& outputs = values_[static_cast<size_t>(node)];
    for (size_t o = 0; o < outputs.size(); ++o) {
      if (outputs[o].last_use < 0) continue;
      const int size = size_of(node, o);
      auto& free = size == 1 ? free_numbers_ : free_triples_;
      if (free.empty()) {
        outputs[o].place = end_;
        end_ += size;
      } else {
        outputs[o].place = free.back();
        free.pop_back();
      }
    }
  }

  void release(IrLink link, int step) {
    Value& v = value(link);
    if (v.last_use != step || v.released) return;
    v.released = true;
    const int size = size_of(link.node, static_cast<size_t>(link.output));
    (size == 1 ? free_numbers_ : free_triples_).push_back(v.place);
  }

  const ShaderIr& ir_;
  const std::vector<ProgramStep>& steps_;
  uint8_t query_;
  RegisterIndex end_;
  std::vector<std::vector<Value>> values_;
  std::vector<RegisterIndex> free_numbers_, free_triples_;
};

}  // namespace

// Copies the nodes of a list of steps and wires them by register.
class ProgramBuilder {
 public:
  ProgramBuilder(const ShaderIr& ir, const std::vector<ProgramStep>& steps, uint8_t query,
                 RegisterIndex base)
      : ir_(ir), steps_(steps), query_(query), registers_(ir, steps, query, base) {}

  // `result`: an output that must last to the end.
  Program build(IrLink result) {
    registers_.run(result);
    program_.register_count_ = static_cast<size_t>(registers_.end());
    std::vector<const NodeType*> types;
    for (const ProgramStep& step : steps_)
      if (step.node >= 0) types.push_back(ir_.at(step.node).type);
    const auto arena = std::make_shared<NodeArena>(types);
    for (const ProgramStep& step : steps_) {
      if (step.node >= 0)
        add_node(step.node, *arena);
      else
        add_jump(step);
    }
    program_.nodes_ = arena;
    return std::move(program_);
  }
  RegisterIndex place_of(IrLink link) const { return registers_.at(link); }

 private:
  void add_jump(const ProgramStep& step) {
    program_.code_.push_back({nullptr, nullptr, registers_.at(step.guard), step.skip});
    program_.notes_.emplace_back();
  }

  void add_node(int n, NodeArena& arena) {
    const IrNode& node = ir_.at(n);
    const NodeType& type = *node.type;
    void* copy = arena.add(node.data.get());
    for (size_t i = 0; i < node.links.size(); ++i) {
      const InputInfo& input = input_info(type, i);
      if (!node.links[i].linked()) continue;
      const RegisterIndex here =
          is_read(node, i, query_) ? registers_.at(node.links[i]) : k_no_register;
      if (input.is_program)
        add_inner_program(copy, input, node.links[i], here);
      else
        set_source(copy, input, here);
    }
    for (size_t o = 0; o < type.outputs.size(); ++o)
      if (type.outputs[o].type != SocketType::closure)
        set_target(copy, type.outputs[o], registers_.at({n, static_cast<int>(o)}));
    if (type.settle) type.settle(copy);
    program_.code_.push_back({type.eval, copy, k_no_register, 0});
    program_.notes_.push_back({&type, node.settings});
  }

  // The program inside a node runs while this one's values are alive: its registers lie behind.
  void add_inner_program(void* node, const InputInfo& input, IrLink value, RegisterIndex here) {
    const std::vector<ProgramStep> steps = order_steps(ir_, value);
    ProgramBuilder builder(ir_, steps, k_every_query, registers_.end());
    auto inner = std::make_shared<const Program>(builder.build(value));
    set_source(node, input, builder.place_of(value));
    program_.register_count_ = std::max(program_.register_count_, inner->register_count());
    set_program(node, input, std::move(inner), here);
  }

  const ShaderIr& ir_;
  const std::vector<ProgramStep>& steps_;
  uint8_t query_;
  RegisterAllocation registers_;
  Program program_;
};

Program emit_program(const ShaderIr& ir, uint8_t query) {
  const std::vector<ProgramStep> steps = order_steps(ir, query);
  if (steps.empty()) return {};
  return ProgramBuilder(ir, steps, query, 0).build({});
}

ProgramInput<Vec3> emit_vector(const ShaderIr& ir, IrLink value) {
  const std::vector<ProgramStep> steps = order_steps(ir, value);
  ProgramBuilder builder(ir, steps, k_every_query, 0);
  ProgramInput<Vec3> emitted;
  emitted.program = std::make_shared<const Program>(builder.build(value));
  emitted.result.source = builder.place_of(value);
  return emitted;
}

}  // namespace tenniel
