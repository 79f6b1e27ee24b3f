// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "shading/node_type.h"

namespace tenniel {

// One step: run a node, or jump over `skip` steps when the register `skip_if_zero` holds 0.
struct Instruction {
  EvalFunction eval = nullptr;  // null: a jump
  const void* node = nullptr;
  RegisterIndex skip_if_zero = k_no_register;
  uint32_t skip = 0;
};

class NodeArena;

// Nodes in execution order with their registers fixed. Immutable and shared by all threads; copies
// share the nodes.
class Program {
 public:
  void run(ShadingContext& context) const {
    const size_t count = code_.size();
    for (size_t i = 0; i < count; ++i) {
      const Instruction& step = code_[i];
      if (step.eval)
        step.eval(step.node, context);
      else if (context.read_register(step.skip_if_zero) == 0.0f)
        i += step.skip;
    }
  }
  bool empty() const { return code_.empty(); }
  // What ShadingContext::reserve needs, programs inside nodes included.
  size_t register_count() const { return register_count_; }
  // One line a step, for tests: "r3 = ShaderNodeMath(ADD, r1, 0.5)". A vector or colour in
  // registers 4 to 6 is "r4:6"; outputs of a node that has several are named, "Alpha r3".
  std::string listing() const;

 private:
  friend class ProgramBuilder;
  struct Note {  // what the listing says of a step beside its registers
    const NodeType* type = nullptr;
    std::string settings;
  };
  std::vector<Instruction> code_;
  std::vector<Note> notes_;                 // parallel to code_
  std::shared_ptr<const NodeArena> nodes_;  // owns what the instructions point at
  size_t register_count_ = 0;
};

}  // namespace tenniel
