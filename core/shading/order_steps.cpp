// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "shading/compiler_passes.h"

namespace tenniel {
namespace {

bool never_adds(const IrNode& closure) {
  return !closure.links.back().linked() &&
         constant(closure.data.get(), closure.type->closure_weight)[0] == 0.0f;
}

bool reads_shading_normal(const ShaderIr& ir, const std::vector<int>& nodes, uint8_t query) {
  return std::any_of(nodes.begin(), nodes.end(), [&](int n) {
    const IrNode& node = ir.at(n);
    for (size_t i = 0; i < node.type->inputs.size(); ++i) {
      const InputInfo& input = node.type->inputs[i];
      if (input.implicit == ImplicitInput::normal && !node.links[i].linked() &&
          (input.queries & query))
        return true;
    }
    return false;
  });
}

// Regions of this program: those without a guard of their own dissolve into the one around them.
class RegionTree {
 public:
  RegionTree(const ShaderIr& ir) : ir_(ir) {
    for (size_t i = 0; i < ir.regions.size(); ++i) {
      const IrRegion& region = ir.regions[i];
      const int outer = region.parent < 0 ? 0 : held_by_[static_cast<size_t>(region.parent)];
      const bool guards = region.guard.linked() && !(region.guard == guard(outer));
      held_by_.push_back(guards ? static_cast<int>(i) : outer);
    }
  }
  // The region of the program that a region of the tree is part of.
  int held_by(int region) const { return held_by_[static_cast<size_t>(region)]; }
  int parent(int region) const { return held_by(ir_.regions[static_cast<size_t>(region)].parent); }
  IrLink guard(int region) const { return ir_.regions[static_cast<size_t>(region)].guard; }
  int common(int a, int b) const { return held_by(ir_.common_region(a, b)); }

 private:
  const ShaderIr& ir_;
  std::vector<int> held_by_;
};

class StepOrder {
 public:
  StepOrder(const ShaderIr& ir, uint8_t query)
      : ir_(ir),
        query_(query),
        tree_(ir),
        home_(ir.nodes.size(), k_unused),
        contents_(ir.regions.size()) {}

  std::vector<ProgramStep> run() {
    std::vector<int> roots;
    for (const IrClosure& closure : closures_of_query(ir_, query_)) {
      const int region = tree_.held_by(closure.region);
      home_[static_cast<size_t>(closure.node)] = region;
      enter(region, roots);
      roots.push_back(closure.node);
    }
    std::vector<int> order = ordered(roots);
    // What is asked for after the surface finds the normal bent already.
    if (ir_.prologue >= 0 && query_ != k_query_aov &&
        ((query_ & k_query_scatter) || reads_shading_normal(ir_, order, query_)))
      steps_.push_back({ir_.prologue, {}, 0});
    settle(order);
    for (int node : order)
      contents_[static_cast<size_t>(home_[static_cast<size_t>(node)])].nodes.push_back(node);
    emit(0);
    return std::move(steps_);
  }

 private:
  static constexpr int k_unused = -1;
  struct Contents {
    std::vector<int> nodes, children;
    bool entered = false;
  };

  std::vector<int> ordered(const std::vector<int>& roots) const {
    return topological_order(
        ir_, roots, [this](const IrNode& node, size_t i) { return is_read(node, i, query_); });
  }

  void use(int node, int region) {
    int& home = home_[static_cast<size_t>(node)];
    home = home == k_unused ? region : tree_.common(home, region);
  }

  // Notes `region` and those around it as part of the program, with the guards that they read.
  void enter(int region, std::vector<int>& roots) {
    while (region != 0 && !contents_[static_cast<size_t>(region)].entered) {
      const int parent = tree_.parent(region), guard = tree_.guard(region).node;
      contents_[static_cast<size_t>(region)].entered = true;
      contents_[static_cast<size_t>(parent)].children.push_back(region);
      use(guard, parent);
      roots.push_back(guard);
      region = parent;
    }
  }

  // Moves each node out to the innermost region that holds all its readers.
  void settle(const std::vector<int>& order) {
    for (auto n = order.rbegin(); n != order.rend(); ++n) {
      const IrNode& node = ir_.at(*n);
      for (size_t i = 0; i < node.links.size(); ++i)
        if (node.links[i].linked() && is_read(node, i, query_))
          use(node.links[i].node, home_[static_cast<size_t>(*n)]);
    }
  }

  void emit(int region) {
    const Contents& contents = contents_[static_cast<size_t>(region)];
    for (int node : contents.nodes)
      steps_.push_back({node, {}, 0});
    for (int child : contents.children) {
      const size_t jump = steps_.size();
      steps_.push_back({-1, tree_.guard(child), 0});
      emit(child);
      steps_[jump].skip = static_cast<uint32_t>(steps_.size() - jump - 1);
    }
  }

  const ShaderIr& ir_;
  uint8_t query_;
  RegionTree tree_;
  std::vector<int> home_;  // region of each node
  std::vector<Contents> contents_;
  std::vector<ProgramStep> steps_;
};

}  // namespace

bool is_read(const IrNode& node, size_t input, uint8_t query) {
  const InputInfo& info = input_info(*node.type, input);
  return (!info.is_program || info.reads_here) && (info.queries & query) != 0;
}

std::vector<IrClosure> closures_of_query(const ShaderIr& ir, uint8_t query) {
  std::vector<IrClosure> kept;
  for (const IrClosure& closure : ir.closures) {
    const IrNode& node = ir.at(closure.node);
    if ((node.type->closure_parts(node.data.get()) & query) && !never_adds(node))
      kept.push_back(closure);
  }
  return kept;
}

std::vector<ProgramStep> order_steps(const ShaderIr& ir, uint8_t query) {
  return StepOrder(ir, query).run();
}

std::vector<ProgramStep> order_steps(const ShaderIr& ir, IrLink value) {
  std::vector<ProgramStep> steps;
  for (int node : topological_order(ir, {value.node}, [](const IrNode&reader, size_t i) {
         return is_read(reader, i, k_every_query);
       }))
    steps.push_back({node, {}, 0});
  return steps;
}

}  // namespace tenniel
