// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "bindings/bind.h"
#include "bindings/fields.h"
#include "shading/node_graph.h"
#include "shading/node_type.h"

namespace tenniel {

namespace {

const char* name_of(SettingKind kind) {
  switch (kind) {
    case SettingKind::boolean:
      return "boolean";
    case SettingKind::integer:
      return "integer";
    case SettingKind::number:
      return "number";
    case SettingKind::choice:
      return "choice";
    case SettingKind::text:
      return "text";
    case SettingKind::table:
      return "table";
    case SettingKind::image:
      return "image";
    case SettingKind::grid:
      return "grid";
    case SettingKind::attribute:
      return "attribute";
    case SettingKind::aov:
      return "aov";
  }
  return "";
}

uint32_t node_index(const NodeGraph& graph, int64_t node, FieldName field) {
  if (node < 0 || static_cast<size_t>(node) >= graph.nodes.size())
    throw_value_error(field, "must be a node of the graph, which has " +
                                 std::to_string(graph.nodes.size()) + ", not " +
                                 std::to_string(node));
  return static_cast<uint32_t>(node);
}

int add_node(NodeGraph& graph, const py::object& type, const py::object& name) {
  GraphNode node;
  node.type = text_from_python(type, {"NodeGraph.add_node", "type"});
  node.name = text_from_python(name, {"NodeGraph.add_node", "name"});
  graph.nodes.push_back(std::move(node));
  return static_cast<int>(graph.nodes.size()) - 1;
}

void set_input(NodeGraph& graph, int64_t node, const py::object& socket, const py::object& value) {
  GraphNode& target = graph.nodes[node_index(graph, node, {"NodeGraph.set_input", "node"})];
  const std::string name = text_from_python(socket, {"NodeGraph.set_input", "socket"});
  const FieldName field{target.type, name};
  std::vector<float> floats = floats_from_python(value, field);
  if (floats.size() != 1 && floats.size() != 3 && floats.size() != 4)
    throw_value_error(field, "needs 1, 3 or 4 numbers, not " + std::to_string(floats.size()));
  target.inputs[name] = std::move(floats);
}

// A bool is an integer to Python, and an integer a number: the narrowest type goes first.
SettingValue setting_from_python(py::handle value, FieldName field) {
  if (PyBool_Check(value.ptr())) return flag_from_python(value, field);
  if (PyIndex_Check(value.ptr())) return Convert<int>::from_python(value, field);
  if (PyFloat_Check(value.ptr())) return number_from_python(value, field);
  if (PyUnicode_Check(value.ptr())) return text_from_python(value, field);
  if (is_sequence(value)) return floats_from_python(value, field);
  throw_type_error(field, "a bool, a number, text or a sequence of numbers", value);
}

void set_setting(NodeGraph& graph, int64_t node, const py::object& name, const py::object& value) {
  GraphNode& target = graph.nodes[node_index(graph, node, {"NodeGraph.set_setting", "node"})];
  std::string key = text_from_python(name, {"NodeGraph.set_setting", "name"});
  SettingValue setting = setting_from_python(value, {target.type, key});
  target.settings[std::move(key)] = std::move(setting);
}

void link(NodeGraph& graph, int64_t from_node, const py::object& from_socket, int64_t to_node,
          const py::object& to_socket) {
  graph.links.push_back({node_index(graph, from_node, {"NodeGraph.link", "from_node"}),
                         text_from_python(from_socket, {"NodeGraph.link", "from_socket"}),
                         node_index(graph, to_node, {"NodeGraph.link", "to_node"}),
                         text_from_python(to_socket, {"NodeGraph.link", "to_socket"})});
}

template <class Info>
py::list identifiers(const std::vector<Info>& sockets) {
  py::list result;
  for (const Info& socket : sockets)
    result.append(text_to_python(socket.identifier));
  return result;
}

void bind_graph(py::module_& module) {
  Fields<NodeGraph>(module, "NodeGraph",
                    "A shader tree, flattened. Sockets and settings by Blender's identifiers.")
      .field("name", &NodeGraph::name)
      .field("output", &NodeGraph::output)
      .field("aov_outputs", &NodeGraph::aov_outputs)
      .bound()
      .def_property_readonly("node_count",
                             [](const NodeGraph& graph) { return graph.nodes.size(); })
      .def("add_node", &add_node, py::arg("type"), py::arg("name"), "Index of the new node.")
      .def("set_input", &set_input, py::arg("node"), py::arg("socket"), py::arg("value"),
           "`value`: 1, 3 or 4 floats.")
      .def("set_setting", &set_setting, py::arg("node"), py::arg("name"), py::arg("value"),
           "`value`: bool, int, float, text, or floats of a table.")
      .def("link", &link, py::arg("from_node"), py::arg("from_socket"), py::arg("to_node"),
           py::arg("to_socket"));
}

void bind_node_types(py::module_& module) {
  // The registry owns its types and lives as long as the module.
  py::class_<NodeType, std::unique_ptr<NodeType, py::nodelete>>(
      module, "NodeTypeInfo", "What the core reads of a node.", py::module_local())
      .def_property_readonly("inputs",
                             [](const NodeType& type) { return identifiers(type.inputs); })
      .def_property_readonly("outputs",
                             [](const NodeType& type) { return identifiers(type.outputs); })
      .def_property_readonly("settings", [](const NodeType& type) {
        py::dict result;
        for (const SettingInfo& setting : type.settings)
          result[text_to_python(setting.name)] = name_of(setting.kind);
        return result;
      });
  module.def(
      "node_types",
      []() {
        py::dict result;
        for (const auto& type : node_registry().all())
          result[text_to_python(type->idname)] =
              py::cast(type.get(), py::return_value_policy::reference);
        return result;
      },
      "bl_idname -> NodeTypeInfo of every node the core knows.");
}

}  // namespace

void bind_nodes(py::module_& module) {
  bind_graph(module);
  bind_node_types(module);
}

}  // namespace tenniel
