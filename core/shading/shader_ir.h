// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shading/node_type.h"

// A shader tree between description and program: typed nodes with their links resolved. Every
// compiler pass (compiler_passes.h) takes one and improves it in place.
namespace tenniel {

// An output of another node; `node` -1: nothing is linked, the input's constant holds.
struct IrLink {
  int node = -1;
  int output = 0;
  bool linked() const { return node >= 0; }
  friend bool operator==(IrLink, IrLink) = default;
};

// Owns one node struct of a registered type.
class NodeData {
 public:
  explicit NodeData(const NodeType& type);
  NodeData(NodeData&& other) noexcept;
  NodeData& operator=(NodeData&& other) noexcept;
  ~NodeData();
  void* get() { return storage_; }
  const void* get() const { return storage_; }

 private:
  const NodeType* type_;
  void* storage_;
};

struct IrNode {
  const NodeType* type;
  NodeData data;
  std::string name;           // for reports
  std::string settings;       // for listings: "ADD, true"
  std::string settings_key;   // equal where all settings are
  std::vector<IrLink> links;  // parallel to the type's inputs; a closure's weight comes last

  explicit IrNode(const NodeType& node_type);
};

// A branch of a Mix Shader: its nodes matter only where `guard` is not zero.
struct IrRegion {
  int parent = -1;
  int depth = 0;
  IrLink guard;  // none: always run
};

struct IrClosure {
  int node = -1;
  int region = 0;
};

struct ShaderIr {
  std::vector<IrNode> nodes;
  int output = -1;                  // of the Material / World / Light Output
  std::vector<int> aovs;            // AOV Outputs that a pass waits for
  int prologue = -1;                // node that bends the shading normal before all others
  std::vector<IrRegion> regions;    // [0] is always run; parents come before children
  std::vector<IrClosure> closures;  // filled by lower_closures
  bool has_surface = false, has_volume = false;

  IrNode& at(int node) { return nodes[static_cast<size_t>(node)]; }
  const IrNode& at(int node) const { return nodes[static_cast<size_t>(node)]; }
  int add(const NodeType& type);
  // Links input `input` of `node`, or unlinks it where `source` is not linked. Keeps the struct's
  // Input::linked() in step, so that closure_parts can tell constants from links.
  void link(int node, size_t input, IrLink source);
  int common_region(int a, int b) const;
};

size_t input_count(const NodeType& type);                         // closure weight included
const InputInfo& input_info(const NodeType& type, size_t input);  // likewise

// Members of a node struct through their descriptions. A number uses the first float only.
using Constant = std::array<float, 3>;
Constant constant(const void* node, const InputInfo& input);
void set_constant(void* node, const InputInfo& input, const Constant& value);
RegisterIndex source(const void* node, const InputInfo& input);
void set_source(void* node, const InputInfo& input, RegisterIndex source);
// Of a ProgramInput; `here` is k_no_register where it is not asked for.
void set_program(void* node, const InputInfo& input, std::shared_ptr<const Program> program,
                 RegisterIndex here);
const Program* program_of(const void* node, const InputInfo& input);  // null where there is none
RegisterIndex target(const void* node, const OutputInfo& output);
void set_target(void* node, const OutputInfo& output, RegisterIndex target);

// Nodes that `roots` need through the inputs that `follows` accepts, every node after those that it
// reads. The graph has no cycles.
using InputFilter = std::function<bool(const IrNode& node, size_t input)>;
std::vector<int> topological_order(const ShaderIr& ir, const std::vector<int>& roots,
                                   const InputFilter& follows);
// The same through every input.
std::vector<int> topological_order(const ShaderIr& ir, const std::vector<int>& roots);
// After lower_closures: the closures and the prologue, which need all that is left of the tree.
std::vector<int> program_roots(const ShaderIr& ir);

}  // namespace tenniel
