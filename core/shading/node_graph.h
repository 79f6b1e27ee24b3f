// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tenniel {

using SettingValue = std::variant<bool, int, float, std::string, std::vector<float>>;

// One node as the exporter found it; groups, reroutes and muted nodes are already resolved.
struct GraphNode {
  std::string type;                                  // bl_idname, e.g. "ShaderNodeMath"
  std::string name;                                  // for reports
  std::map<std::string, std::vector<float>> inputs;  // socket identifier -> 1, 3 or 4 floats
  // RNA name -> value: enums as their identifier, ramps and curves as tables, images as the index
  // into SceneDescription::images, attribute names as text.
  std::map<std::string, SettingValue> settings;

  bool operator==(const GraphNode&) const = default;
};

struct GraphLink {
  uint32_t from = 0;
  std::string from_socket;  // identifier
  uint32_t to = 0;
  std::string to_socket;

  bool operator==(const GraphLink&) const = default;
};

// Plain description of a shader tree. `output` is the Material / World / Light Output node.
struct NodeGraph {
  std::string name;
  std::vector<GraphNode> nodes;
  std::vector<GraphLink> links;
  int output = -1;
  std::vector<int> aov_outputs;  // AOV Output nodes, roots besides the output

  bool operator==(const NodeGraph&) const = default;
};

}  // namespace tenniel
