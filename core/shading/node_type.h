// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shading/grid_medium.h"
#include "shading/shading_context.h"
#include "shading/socket.h"
#include "shading/sun_disk.h"

namespace tenniel {

class Program;
class Texture;

// An input that the node evaluates itself, as often and where it likes (bump: at three points).
// `result` is a constant, or the register that `program` writes; null program: the constant.
// Programs are run through ShadingContext alone, so a node may move `surface` in between. Where the
// node says `read_here`, `here` is the value at the point itself, shared with other readers.
template <class T>
struct ProgramInput {
  Input<T> result;
  Input<T> here;
  std::shared_ptr<const Program> program;
};

// What feeds an input that has no link: its own value, or a coordinate that Blender implies.
// `normal` and `tangent` stay unlinked: the node reads them by ShadingContext::normal.
enum class ImplicitInput : uint8_t {
  none,
  normal,
  tangent,
  generated,
  uv,
  direction,
  object_normal
};

// Members that are filled from outside the socket system.
struct ImageSlot {
  int image = -1;                    // index into SceneDescription::images
  const Texture* texture = nullptr;  // set by the compiler; null: missing, shown magenta
};
struct GridSlot {
  int index = -1;                   // into SceneDescription::grids
  const VoxelGrid* grid = nullptr;  // set by the compiler; null: there is nothing
};
struct AttributeSlot {
  std::string name;
  int id = -1;  // AttributeIds, set by the compiler
};

struct AovSlot {
  std::string name;
  int channel = -1;  // AovPass, set by the compiler; -1: the picture has no pass of that name
  bool is_color = false;
};

struct InputInfo {
  std::string identifier;
  SocketType type = SocketType::number;
  size_t offset = 0;  // of the Input<T> in the node; unused for closures
  ImplicitInput implicit = ImplicitInput::none;
  uint8_t queries = 0xff;   // ShaderQuery parts that read this input
  bool is_program = false;  // the member is a ProgramInput<T>
  bool reads_here = false;  // and its `here` is asked for
};

struct OutputInfo {
  std::string identifier;
  SocketType type = SocketType::number;
  size_t offset = 0;
};

enum class SettingKind : uint8_t {
  boolean,
  integer,
  number,
  choice,
  text,
  table,
  image,
  grid,
  attribute,
  aov
};

struct SettingInfo {
  std::string name;  // RNA name
  SettingKind kind = SettingKind::boolean;
  size_t offset = 0;
  std::vector<std::string> choices;  // identifiers, in the order of the enum
  std::function<void(void* node, size_t choice)> set_choice;  // kind == choice
  std::string suffix;                                         // kind == attribute
};

using EvalFunction = void (*)(const void* node, ShadingContext&);

// One row of the registry: how Blender names a node and where its parts lie in our struct.
struct NodeType {
  std::string idname;
  size_t size = 0, alignment = 0;
  void (*construct)(void*) = nullptr;
  void (*copy)(void* to, const void* from) = nullptr;
  void (*destroy)(void*) = nullptr;
  EvalFunction eval = nullptr;  // null: taken apart by the compiler, never run
  // Which ShaderQuery parts this closure node adds to, from its constant inputs; null: no closure.
  uint8_t (*closure_parts)(const void* node) = nullptr;
  std::vector<InputInfo> inputs;
  std::vector<OutputInfo> outputs;
  std::vector<SettingInfo> settings;
  // A sentence on what this node, as it is set, does not get; null: nothing to say.
  const char* (*note)(const void* node) = nullptr;
  // Makes what the node keeps besides its settings, once they are set; null: nothing.
  void (*prepare)(void* node) = nullptr;
  // Makes of inputs without a link what eval would make at each run, once they are final; null:
  // nothing. A node that is folded is run without it.
  void (*settle)(void* node) = nullptr;
  // Whether this closure, as it is set, may take light below the surface; null: never.
  bool (*has_subsurface)(const void* node) = nullptr;
  // Whether this closure, as it is set, reads more than its inputs; null: never.
  bool (*varies)(const void* node) = nullptr;
  // A sun that this texture shows where it is asked for plain directions; null: never.
  std::optional<SunDisk> (*sun_disk)(const void* node) = nullptr;
  // What this closure, as it is set and without links, is made of by one grid; null: never.
  std::optional<GridMedium> (*grid_medium)(const void* node) = nullptr;
  InputInfo closure_weight;  // of a closure: its Input<float> weight, set by the compiler
  bool is_pure = true;       // depends on its inputs alone: may be folded

  bool is_closure() const { return closure_parts != nullptr; }
  const InputInfo* input(std::string_view identifier) const;
  const OutputInfo* output(std::string_view identifier) const;
  const SettingInfo* setting(std::string_view name) const;
};

// Fluent description of one node struct, used beside the struct:
//   registry.add<MathNode>("ShaderNodeMath")
//       .input("Value", &MathNode::a).output("Value", &MathNode::result)
//       .choice("operation", &MathNode::operation, {{"ADD", MathOperation::add}, ...});
// A node struct has `void eval(ShadingContext&) const`; a closure node also `Input<float> weight`
// and `uint8_t closure_parts() const`. Nodes that only direct closures (Mix Shader, outputs) have
// no eval: the compiler takes them apart. A closure node's eval adds only the parts that
// ShadingContext::query asks for, each scaled by `weight`. `const char* note() const`,
// `bool has_subsurface() const`, `bool varies() const`, `void prepare()`,
// `void settle()`, `std::optional<SunDisk> sun_disk() const` and
// `std::optional<GridMedium> grid_medium() const` are optional.
template <class Node>
class NodeTypeBuilder {
 public:
  explicit NodeTypeBuilder(NodeType& type) : type_(type) {}

  template <class T>
  NodeTypeBuilder& input(std::string identifier, Input<T> Node::*member, uint8_t queries = 0xff) {
    type_.inputs.push_back(
        {std::move(identifier), socket_type<T>(), offset_of(member), ImplicitInput::none, queries});
    return *this;
  }
  template <class T>
  NodeTypeBuilder& input(std::string identifier, ProgramInput<T> Node::*member,
                         uint8_t queries = 0xff) {
    type_.inputs.push_back({std::move(identifier), socket_type<T>(), offset_of(member),
                            ImplicitInput::none, queries, true});
    return *this;
  }
  // For the input named last.
  NodeTypeBuilder& implicit(ImplicitInput kind) {
    type_.inputs.back().implicit = kind;
    return *this;
  }
  // Likewise, of a ProgramInput.
  NodeTypeBuilder& read_here() {
    type_.inputs.back().reads_here = true;
    return *this;
  }
  NodeTypeBuilder& closure_input(std::string identifier) {
    type_.inputs.push_back({std::move(identifier), SocketType::closure});
    return *this;
  }
  template <class T>
  NodeTypeBuilder& output(std::string identifier, Output<T> Node::*member) {
    type_.outputs.push_back({std::move(identifier), socket_type<T>(), offset_of(member)});
    return *this;
  }
  NodeTypeBuilder& closure_output(std::string identifier) {
    type_.outputs.push_back({std::move(identifier), SocketType::closure, 0});
    return *this;
  }
  NodeTypeBuilder& setting(std::string name, bool Node::*member) {
    return plain(std::move(name), SettingKind::boolean, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, int Node::*member) {
    return plain(std::move(name), SettingKind::integer, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, float Node::*member) {
    return plain(std::move(name), SettingKind::number, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, std::string Node::*member) {
    return plain(std::move(name), SettingKind::text, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, std::vector<float> Node::*member) {
    return plain(std::move(name), SettingKind::table, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, ImageSlot Node::*member) {
    return plain(std::move(name), SettingKind::image, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, GridSlot Node::*member) {
    return plain(std::move(name), SettingKind::grid, offset_of(member));
  }
  NodeTypeBuilder& setting(std::string name, AovSlot Node::*member) {
    return plain(std::move(name), SettingKind::aov, offset_of(member));
  }
  // `suffix` is added to the name: ".tangent" for what is derived from a UV map. One setting may
  // fill several slots.
  NodeTypeBuilder& setting(std::string name, AttributeSlot Node::*member, std::string suffix = "") {
    plain(std::move(name), SettingKind::attribute, offset_of(member));
    type_.settings.back().suffix = std::move(suffix);
    return *this;
  }
  template <class Enum>
  NodeTypeBuilder& choice(std::string name, Enum Node::*member,
                          std::initializer_list<std::pair<const char*, Enum>> items) {
    SettingInfo info{std::move(name), SettingKind::choice, offset_of(member), {}, {}, {}};
    std::vector<Enum> values;
    for (const auto& [identifier, value] : items) {
      info.choices.emplace_back(identifier);
      values.push_back(value);
    }
    info.set_choice = [member, values = std::move(values)](void* node, size_t i) {
      static_cast<Node*>(node)->*member = values[i];
    };
    type_.settings.push_back(std::move(info));
    return *this;
  }
  // Reads more than its inputs (geometry, path, images of the scene): never folded.
  NodeTypeBuilder& varying() {
    type_.is_pure = false;
    return *this;
  }
  NodeTypeBuilder& closure() {
    type_.is_pure = false;
    type_.closure_weight = {"weight", SocketType::number, offset_of(&Node::weight)};
    type_.closure_parts = [](const void* node) {
      return static_cast<const Node*>(node)->closure_parts();
    };
    return *this;
  }

 private:
  template <class Member>
  static size_t offset_of(Member Node::*member) {
    static const Node sample{};
    return static_cast<size_t>(reinterpret_cast<const char*>(&(sample.*member)) -
                               reinterpret_cast<const char*>(&sample));
  }
  NodeTypeBuilder& plain(std::string name, SettingKind kind, size_t offset) {
    type_.settings.push_back({std::move(name), kind, offset, {}, {}, {}});
    return *this;
  }
  NodeType& type_;
};

// All node types the engine knows, by bl_idname.
class NodeRegistry {
 public:
  template <class Node>
  NodeTypeBuilder<Node> add(std::string idname) {
    NodeType& type = *types_.emplace_back(std::make_unique<NodeType>());
    type.size = sizeof(Node);
    type.alignment = alignof(Node);
    type.construct = [](void* p) { new (p) Node(); };
    type.copy = [](void* to, const void* from) { new (to) Node(*static_cast<const Node*>(from)); };
    type.destroy = [](void* p) { static_cast<Node*>(p)->~Node(); };
    if constexpr (requires(const Node& node, ShadingContext& context) { node.eval(context); }) {
      type.eval = [](const void* node, ShadingContext& context) {
        static_cast<const Node*>(node)->eval(context);
      };
    }
    if constexpr (requires(const Node& node) { node.note(); })
      type.note = [](const void* node) { return static_cast<const Node*>(node)->note(); };
    if constexpr (requires(const Node& node) { node.has_subsurface(); })
      type.has_subsurface = [](const void* node) {
        return static_cast<const Node*>(node)->has_subsurface();
      };
    if constexpr (requires(const Node& node) { node.varies(); })
      type.varies = [](const void* node) { return static_cast<const Node*>(node)->varies(); };
    if constexpr (requires(Node & node) { node.prepare(); })
      type.prepare = [](void* node) { static_cast<Node*>(node)->prepare(); };
    if constexpr (requires(Node & node) { node.settle(); })
      type.settle = [](void* node) { static_cast<Node*>(node)->settle(); };
    if constexpr (requires(const Node& node) { node.sun_disk(); })
      type.sun_disk = [](const void* node) { return static_cast<const Node*>(node)->sun_disk(); };
    if constexpr (requires(const Node& node) { node.grid_medium(); })
      type.grid_medium = [](const void* node) {
        return static_cast<const Node*>(node)->grid_medium();
      };
    by_name_.emplace(idname, &type);
    type.idname = std::move(idname);
    return NodeTypeBuilder<Node>(type);
  }
  const NodeType* find(const std::string& idname) const;
  const std::vector<std::unique_ptr<NodeType>>& all() const { return types_; }

 private:
  std::vector<std::unique_ptr<NodeType>> types_;
  std::unordered_map<std::string, NodeType*> by_name_;
};

// The one registry, filled on first use from the `register_*` functions of shading/nodes/.
const NodeRegistry& node_registry();

}  // namespace tenniel
