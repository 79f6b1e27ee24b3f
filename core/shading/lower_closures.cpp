// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "shading/compiler_passes.h"
#include "shading/internal_nodes.h"

namespace tenniel {
namespace {

// A factor for each closure below a point of the tree: a constant or a link.
struct Weight {
  IrLink link;
  float value = 1.0f;
};

// Walks from the output to the closures, readers before what they read, so that each node knows
// the sum of all paths to it before it passes its weight on. Linear in the graph, however often
// subtrees are shared.
class ClosureLowering {
 public:
  explicit ClosureLowering(ShaderIr& ir) : ir_(ir) {}

  void run() {
    const IrNode& output = ir_.at(ir_.output);
    for (size_t i = 0; i < output.type->inputs.size(); ++i)
      if (is_closure_input(ir_.output, i) && output.links[i].linked())
        arrivals(output.links[i].node).push_back({{}, 0});
    for (int node : readers_first()) {
      if (arrivals(node).empty()) continue;
      if (ir_.at(node).type->is_closure())
        place(node);
      else
        split(node);
    }
  }

 private:
  struct Arrival {
    Weight weight;
    int region = 0;
  };

  std::vector<Arrival>& arrivals(int node) {
    if (arrivals_.size() <= static_cast<size_t>(node)) arrivals_.resize(ir_.nodes.size());
    return arrivals_[static_cast<size_t>(node)];
  }

  bool is_closure_input(int node, size_t input) const {
    return input_info(*ir_.at(node).type, input).type == SocketType::closure;
  }

  std::vector<int> readers_first() const {
    std::vector<int> order = topological_order(ir_, {ir_.output});
    std::reverse(order.begin(), order.end());
    std::erase(order, ir_.output);
    return order;
  }

  void set_weight(int node, size_t input, const Weight& weight) {
    ir_.link(node, input, weight.link);
    set_constant(ir_.at(node).data.get(), input_info(*ir_.at(node).type, input),
                 {weight.value, 0.0f, 0.0f});
  }

  // The sum of what arrives at `node`, and the innermost region that holds all of it.
  Arrival gather(int node) {
    const std::vector<Arrival> all = arrivals(node);
    Arrival sum = all.front();
    for (size_t i = 1; i < all.size(); ++i) {
      const int add = ir_.add(add_weights_node());
      set_weight(add, 0, sum.weight);
      set_weight(add, 1, all[i].weight);
      sum = {{{add, 0}, 0.0f}, ir_.common_region(sum.region, all[i].region)};
    }
    return sum;
  }

  int add_region(int parent, const Weight& guard) {
    const int depth = ir_.regions[static_cast<size_t>(parent)].depth + 1;
    ir_.regions.push_back({parent, depth, guard.link});
    return static_cast<int>(ir_.regions.size()) - 1;
  }

  void place(int closure) {
    Arrival sum = gather(closure);
    if (arrivals(closure).size() > 1) sum.region = add_region(sum.region, sum.weight);
    const size_t weight_input = ir_.at(closure).type->inputs.size();
    set_weight(closure, weight_input, sum.weight);
    ir_.closures.push_back({closure, sum.region});
  }

  // A node with a factor divides its weight between its two shaders, one without gives it to each.
  void split(int node) {
    const Arrival sum = gather(node);
    const NodeType& type = *ir_.at(node).type;
    int mix = -1;
    for (size_t i = 0; i < type.inputs.size() && mix < 0; ++i) {
      if (type.inputs[i].type != SocketType::number) continue;
      mix = ir_.add(mix_weights_node());
      set_weight(mix, 0, sum.weight);
      set_weight(mix, 1,
                 {ir_.at(node).links[i], constant(ir_.at(node).data.get(), type.inputs[i])[0]});
    }
    int branch = 0;
    for (size_t i = 0; i < type.inputs.size(); ++i) {
      if (type.inputs[i].type != SocketType::closure) continue;
      const IrLink child = ir_.at(node).links[i];
      const int output = branch++;
      if (!child.linked()) continue;
      Arrival down = sum;
      if (mix >= 0) {
        down.weight = {{mix, output}, 0.0f};
        down.region = add_region(sum.region, down.weight);
      }
      arrivals(child.node).push_back(down);
    }
  }

  ShaderIr& ir_;
  std::vector<std::vector<Arrival>> arrivals_;
};

}  // namespace

void lower_closures(ShaderIr& ir) {
  if (ir.output >= 0) ClosureLowering(ir).run();
  for (const int aov : ir.aovs)
    ir.closures.push_back({aov, 0});
}

}  // namespace tenniel
