// SPDX-License-Identifier: Apache-2.0
#include "shading/node_type.h"

#include "shading/nodes/register.h"

namespace tenniel {
namespace {

template <class Info>
const Info* find_info(const std::vector<Info>& infos, std::string Info::*key,
                      std::string_view wanted) {
  for (const Info& info : infos)
    if (info.*key == wanted) return &info;
  return nullptr;
}

}  // namespace

const InputInfo* NodeType::input(std::string_view identifier) const {
  return find_info(inputs, &InputInfo::identifier, identifier);
}

const OutputInfo* NodeType::output(std::string_view identifier) const {
  return find_info(outputs, &OutputInfo::identifier, identifier);
}

const SettingInfo* NodeType::setting(std::string_view name) const {
  return find_info(settings, &SettingInfo::name, name);
}

const NodeType* NodeRegistry::find(const std::string& idname) const {
  const auto it = by_name_.find(idname);
  return it == by_name_.end() ? nullptr : it->second;
}

const NodeRegistry& node_registry() {
  static const NodeRegistry registry = [] {
    NodeRegistry all;
    register_math_nodes(all);
    register_vector_nodes(all);
    register_color_nodes(all);
    register_converter_nodes(all);
    register_input_nodes(all);
    register_coordinate_nodes(all);
    register_info_nodes(all);
    register_lamp_nodes(all);
    register_image_nodes(all);
    register_pattern_nodes(all);
    register_sky_nodes(all);
    register_closure_nodes(all);
    register_artistic_closures(all);
    register_tracing_nodes(all);
    register_subsurface_nodes(all);
    register_principled_nodes(all);
    register_principled_hair(all);
    register_volume_nodes(all);
    register_bump_nodes(all);
    register_aov_nodes(all);
    register_output_nodes(all);
    return all;
  }();
  return registry;
}

}  // namespace tenniel
