// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "shading/compiler_passes.h"

namespace tenniel {
namespace {

// What stands in for a shader that the engine does not know: Blender's default surface.
constexpr const char* k_stand_in_shader = "ShaderNodeBsdfDiffuse";
// What a surface is that only bounds a volume.
constexpr const char* k_pass_through_shader = "ShaderNodeBsdfTransparent";

// Reads the graph from its output backwards, so that what nobody needs is neither kept nor
// reported.
class IrBuilder {
 public:
  IrBuilder(const NodeGraph& graph, const CompileContext& context, ShaderRoot root)
      : graph_(graph),
        root_(root),
        context_(context),
        registry_(context.registry ? *context.registry : node_registry()),
        ids_(graph.nodes.size(), k_unvisited),
        links_to_(graph.nodes.size()) {}

  ShaderIr build(ShaderDomain domain) {
    index_links();
    ir_.regions.emplace_back();
    if (graph_.output < 0 || static_cast<size_t>(graph_.output) >= graph_.nodes.size())
      return std::move(ir_);
    ir_.output = visit(static_cast<uint32_t>(graph_.output));
    if (domain == ShaderDomain::surface && root_ == ShaderRoot::surface) visit_aovs();
    while (!pending_.empty()) {
      const uint32_t node = pending_.back();
      pending_.pop_back();
      for (size_t link : links_to_[node])
        resolve(graph_.links[link]);
    }
    if (domain == ShaderDomain::surface && root_ == ShaderRoot::surface && ir_.has_volume &&
        !ir_.has_surface)
      pass_through();
    return std::move(ir_);
  }

 private:
  static constexpr int k_unvisited = -2, k_unknown = -1;

  void index_links() {
    const size_t count = graph_.nodes.size();
    for (size_t i = 0; i < graph_.links.size(); ++i) {
      const GraphLink& link = graph_.links[i];
      if (link.from < count && link.to < count)
        links_to_[link.to].push_back(i);
      else
        report(context_, graph_.name, "a link names a node that does not exist");
    }
  }

  // The IR node of a graph node, made on the first call; k_unknown where its type is not known.
  int visit(uint32_t index) {
    int& id = ids_[index];
    if (id != k_unvisited) return id;
    const GraphNode& from = graph_.nodes[index];
    const NodeType* type = registry_.find(from.type);
    if (!type) {
      report(context_, from.name,
             "node type " + from.type + " is not supported; what reads it keeps its own value, " +
                 "a shader is shown as plain diffuse");
      return id = k_unknown;
    }
    id = ir_.add(*type);
    IrNode& node = ir_.at(id);
    node.name = from.name;
    apply_settings(node, from, context_);
    apply_inputs(node, from, context_);
    pending_.push_back(index);
    return id;
  }

  // Those that no pass waits for are as good as not there.
  void visit_aovs() {
    for (const int index : graph_.aov_outputs) {
      if (index < 0 || static_cast<size_t>(index) >= graph_.nodes.size()) continue;
      const int id = visit(static_cast<uint32_t>(index));
      if (id == k_unknown) continue;
      const IrNode& node = ir_.at(id);
      if (node.type->is_closure() && node.type->closure_parts(node.data.get()) == k_query_aov)
        ir_.aovs.push_back(id);
      else
        pending_.pop_back();
    }
  }

  void resolve(const GraphLink& link) {
    const int to = ids_[link.to];
    const std::vector<InputInfo>& inputs = ir_.at(to).type->inputs;
    size_t input = 0;
    while (input < inputs.size() && inputs[input].identifier != link.to_socket)
      ++input;
    if (input == inputs.size()) {
      report(context_, ir_.at(to).name,
             "input '" + link.to_socket + "' is unknown; its link is cut");
      return;
    }
    if (to == ir_.output && skips(link.to_socket)) return;
    const bool is_closure = inputs[input].type == SocketType::closure;
    const int from = visit(link.from);
    if (from != k_unknown)
      ir_.link(to, input, output_link(from, link.from_socket));
    else if (is_closure)
      ir_.link(to, input, stand_in(link.from));
  }

  // Parts of the output node that lead elsewhere than to the root, or to nothing at all.
  bool skips(const std::string& socket) {
    if (socket == "Surface") ir_.has_surface = true;
    if (socket == "Volume") ir_.has_volume = true;
    return root_ == ShaderRoot::volume ? socket != "Volume"
                                       : socket == "Volume" || socket == "Thickness";
  }

  IrLink output_link(int from, const std::string& socket) {
    const std::vector<OutputInfo>& outputs = ir_.at(from).type->outputs;
    for (size_t i = 0; i < outputs.size(); ++i)
      if (outputs[i].identifier == socket) return {from, static_cast<int>(i)};
    report(context_, ir_.at(from).name, "output '" + socket + "' is unknown; its link is cut");
    return {};
  }

  IrLink stand_in(uint32_t index) {
    const NodeType* type = registry_.find(k_stand_in_shader);
    if (!type) return {};
    if (stand_in_ < 0) {
      stand_in_ = ir_.add(*type);
      ir_.at(stand_in_).name = graph_.nodes[index].name;
    }
    return {stand_in_, 0};
  }

  void pass_through() {
    const NodeType* type = registry_.find(k_pass_through_shader);
    if (!type) return;
    const std::vector<InputInfo>& inputs = ir_.at(ir_.output).type->inputs;
    for (size_t i = 0; i < inputs.size(); ++i)
      if (inputs[i].identifier == "Surface") ir_.link(ir_.output, i, {ir_.add(*type), 0});
  }

  const NodeGraph& graph_;
  const ShaderRoot root_;
  const CompileContext& context_;
  const NodeRegistry& registry_;
  std::vector<int> ids_;
  std::vector<std::vector<size_t>> links_to_;
  std::vector<uint32_t> pending_;
  int stand_in_ = -1;
  ShaderIr ir_;
};

}  // namespace

ShaderIr build_ir(const MaterialSource& source, const CompileContext& context, ShaderRoot root) {
  static const NodeGraph empty;
  return IrBuilder(source.graph ? *source.graph : empty, context, root).build(source.domain);
}

namespace {

class CycleBreaker {
 public:
  CycleBreaker(ShaderIr& ir, const CompileContext& context)
      : ir_(ir), context_(context), states_(ir.nodes.size(), State::unseen) {}

  void run_from(int root) {
    if (root < 0 || state(root) != State::unseen) return;
    open(root);
    while (!stack_.empty()) {
      Visit& top = stack_.back();
      const int reader = top.node;
      if (top.next_input == ir_.at(reader).links.size()) {
        state(reader) = State::done;
        stack_.pop_back();
      } else {
        follow(reader, top.next_input++);
      }
    }
  }

 private:
  enum class State : uint8_t { unseen, open, done };
  struct Visit {
    int node;
    size_t next_input;
  };

  State& state(int node) { return states_[static_cast<size_t>(node)]; }
  void open(int node) {
    state(node) = State::open;
    stack_.push_back({node, 0});
  }
  void follow(int reader, size_t input) {
    const int from = ir_.at(reader).links[input].node;
    if (from < 0) return;
    if (state(from) == State::open) {
      report(context_, ir_.at(reader).name,
             "the link from '" + ir_.at(from).name + "' closes a cycle and is cut");
      ir_.link(reader, input, {});
    } else if (state(from) == State::unseen) {
      open(from);
    }
  }

  ShaderIr& ir_;
  const CompileContext& context_;
  std::vector<State> states_;
  std::vector<Visit> stack_;
};

}  // namespace

void break_cycles(ShaderIr& ir, const CompileContext& context) {
  CycleBreaker breaker(ir, context);
  breaker.run_from(ir.output);
  for (const int aov : ir.aovs)
    breaker.run_from(aov);
}

}  // namespace tenniel
