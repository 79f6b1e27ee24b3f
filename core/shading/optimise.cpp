// SPDX-License-Identifier: Apache-2.0
#include <numeric>
#include <optional>
#include <unordered_map>

#include "shading/compiler_passes.h"
#include "shading/internal_nodes.h"

namespace tenniel {
namespace {

// What an output turned out to be: a constant, or another output.
struct Replacement {
  IrLink link;
  Constant value{};
};

class ConstantFolding {
 public:
  ConstantFolding(ShaderIr& ir, ShaderDomain domain) : ir_(ir), found_(ir.nodes.size()) {
    context_.domain = domain;
  }

  void run() {
    for (int n : topological_order(ir_, program_roots(ir_))) {
      for (size_t i = 0; i < ir_.at(n).links.size(); ++i)
        replace_input(n, i);
      if (is_constant(ir_.at(n)))
        evaluate(n);
      else
        simplify_weights(n);
    }
    for (IrRegion& region : ir_.regions)
      if (const Replacement* r = replacement(region.guard)) region.guard = r->link;
  }

 private:
  const Replacement* replacement(IrLink link) const {
    if (!link.linked()) return nullptr;
    const auto& outputs = found_[static_cast<size_t>(link.node)];
    const auto i = static_cast<size_t>(link.output);
    return i < outputs.size() && outputs[i] ? &*outputs[i] : nullptr;
  }

  static bool implies_direction(const InputInfo& input) {
    return input.implicit == ImplicitInput::normal || input.implicit == ImplicitInput::tangent;
  }

  void replace_input(int n, size_t i) {
    IrNode& node = ir_.at(n);
    const Replacement* r = replacement(node.links[i]);
    if (!r) return;
    // A constant there would be taken for the implied normal: it stays a link.
    if (!r->link.linked() && implies_direction(input_info(*node.type, i))) return;
    ir_.link(n, i, r->link);
    if (!r->link.linked()) set_constant(node.data.get(), input_info(*node.type, i), r->value);
  }

  static bool is_constant(const IrNode& node) {
    if (!node.type->is_pure || !node.type->eval) return false;
    for (size_t i = 0; i < node.links.size(); ++i) {
      const InputInfo& input = input_info(*node.type, i);
      if (node.links[i].linked() || input.is_program || implies_direction(input)) return false;
    }
    return true;
  }

  // Runs the node's own eval, so that its meaning stands once.
  void evaluate(int n) {
    IrNode& node = ir_.at(n);
    const std::vector<OutputInfo>& outputs = node.type->outputs;
    const auto slot = [](size_t output) { return static_cast<RegisterIndex>(3 * output); };
    context_.reserve(3 * outputs.size());
    for (size_t o = 0; o < outputs.size(); ++o)
      set_target(node.data.get(), outputs[o], slot(o));
    node.type->eval(node.data.get(), context_);
    auto& found = found_[static_cast<size_t>(n)];
    for (size_t o = 0; o < outputs.size(); ++o) {
      set_target(node.data.get(), outputs[o], k_no_register);
      Replacement constant;
      for (int c = 0; c < register_count(outputs[o].type); ++c)
        constant.value[static_cast<size_t>(c)] = context_.read_register(slot(o) + c);
      found.push_back(constant);
    }
  }

  // A mix of all or nothing, or a sum with nothing, passes a weight on as it is: then shaders
  // that are never seen get weight 0 and are pruned.
  void simplify_weights(int n) {
    const IrNode& node = ir_.at(n);
    const auto& links = node.links;
    const auto value = [&](size_t i) { return constant(node.data.get(), node.type->inputs[i])[0]; };
    auto& found = found_[static_cast<size_t>(n)];
    if (node.type == &mix_weights_node()) {
      const float factor = value(1), weight = value(0);
      if (links[1].linked()) return;
      const Replacement all{links[0], {weight}}, nothing{};
      if (factor <= 0.0f)
        found = {all, nothing};
      else if (factor >= 1.0f)
        found = {nothing, all};
    } else if (node.type == &add_weights_node()) {
      for (size_t i : {0u, 1u})
        if (!links[i].linked() && value(i) == 0.0f)
          found = {Replacement{links[1 - i], {value(1 - i)}}};
    }
  }

  ShaderIr& ir_;
  ShadingContext context_;
  std::vector<std::vector<std::optional<Replacement>>> found_;
};

void append(std::string& key, const void* bytes, size_t size) {
  key.append(static_cast<const char*>(bytes), size);
}

// Equal for nodes that give equal results.
std::string node_key(const IrNode& node) {
  std::string key;
  const auto type = reinterpret_cast<uintptr_t>(node.type);
  append(key, &type, sizeof type);
  for (size_t i = 0; i < node.links.size(); ++i) {
    const IrLink link = node.links[i];
    append(key, &link, sizeof link);
    const InputInfo& input = input_info(*node.type, i);
    if (link.linked() || input.type == SocketType::closure) continue;
    const Constant value = constant(node.data.get(), input);
    append(key, value.data(), sizeof value);
  }
  return key + node.settings_key;
}

}  // namespace

void fold_constants(ShaderIr& ir, ShaderDomain domain) {
  ConstantFolding(ir, domain).run();
}

void share_equal_nodes(ShaderIr& ir) {
  std::unordered_map<std::string, int> first_of;
  std::vector<int> same(ir.nodes.size());
  std::iota(same.begin(), same.end(), 0);
  const auto redirect = [&same](IrLink& link) {
    if (link.linked()) link.node = same[static_cast<size_t>(link.node)];
  };
  for (int n : topological_order(ir, program_roots(ir))) {
    IrNode& node = ir.at(n);
    for (IrLink& link : node.links)
      redirect(link);
    if (node.type->is_closure() || n == ir.prologue) continue;
    same[static_cast<size_t>(n)] = first_of.try_emplace(node_key(node), n).first->second;
  }
  for (IrRegion& region : ir.regions)
    redirect(region.guard);
}

}  // namespace tenniel
