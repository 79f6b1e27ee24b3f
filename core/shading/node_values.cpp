// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shading/compiler_passes.h"

namespace tenniel {
namespace {

template <class T>
T& member(void* node, const SettingInfo& setting) {
  return *reinterpret_cast<T*>(static_cast<char*>(node) + setting.offset);
}

bool assign_number(void* node, const SettingInfo& setting, const SettingValue& value) {
  float number = 0.0f;
  if (const auto* f = std::get_if<float>(&value))
    number = *f;
  else if (const auto* i = std::get_if<int>(&value))
    number = static_cast<float>(*i);
  else
    return false;
  if (!std::isfinite(number)) return false;
  member<float>(node, setting) = number;
  return true;
}

bool assign_integer(void* node, const SettingInfo& setting, const SettingValue& value) {
  if (const auto* i = std::get_if<int>(&value))
    member<int>(node, setting) = *i;
  else if (const auto* b = std::get_if<bool>(&value))
    member<int>(node, setting) = *b ? 1 : 0;
  else
    return false;
  return true;
}

bool assign_boolean(void* node, const SettingInfo& setting, const SettingValue& value) {
  if (const auto* b = std::get_if<bool>(&value))
    member<bool>(node, setting) = *b;
  else if (const auto* i = std::get_if<int>(&value))
    member<bool>(node, setting) = *i != 0;
  else
    return false;
  return true;
}

bool assign_choice(void* node, const SettingInfo& setting, const SettingValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (!text) return false;
  const auto it = std::find(setting.choices.begin(), setting.choices.end(), *text);
  if (it == setting.choices.end()) return false;
  setting.set_choice(node, static_cast<size_t>(it - setting.choices.begin()));
  return true;
}

template <class T>
bool assign_same(void* node, const SettingInfo& setting, const SettingValue& value) {
  const auto* same = std::get_if<T>(&value);
  if (same) member<T>(node, setting) = *same;
  return same != nullptr;
}

bool assign_table(void* node, const SettingInfo& setting, const SettingValue& value) {
  const auto* table = std::get_if<std::vector<float>>(&value);
  if (!table ||
      !std::all_of(table->begin(), table->end(), [](float x) { return std::isfinite(x); }))
    return false;
  member<std::vector<float>>(node, setting) = *table;
  return true;
}

bool assign(void* node, const SettingInfo& setting, const SettingValue& value) {
  switch (setting.kind) {
    case SettingKind::boolean:
      return assign_boolean(node, setting, value);
    case SettingKind::integer:
      return assign_integer(node, setting, value);
    case SettingKind::number:
      return assign_number(node, setting, value);
    case SettingKind::choice:
      return assign_choice(node, setting, value);
    case SettingKind::text:
      return assign_same<std::string>(node, setting, value);
    case SettingKind::table:
      return assign_table(node, setting, value);
    case SettingKind::image:
      if (const auto* index = std::get_if<int>(&value))
        return member<ImageSlot>(node, setting).image = *index, true;
      return false;
    case SettingKind::grid:
      if (const auto* index = std::get_if<int>(&value))
        return member<GridSlot>(node, setting).index = *index, true;
      return false;
    case SettingKind::attribute:
      if (const auto* name = std::get_if<std::string>(&value))
        return member<AttributeSlot>(node, setting).name = *name, true;
      return false;
    case SettingKind::aov:
      if (const auto* name = std::get_if<std::string>(&value))
        return member<AovSlot>(node, setting).name = *name, true;
      return false;
  }
  return false;
}

std::string text_setting(const GraphNode& from, const char* name, const char* fallback) {
  const auto it = from.settings.find(name);
  const auto* text = it == from.settings.end() ? nullptr : std::get_if<std::string>(&it->second);
  return text ? *text : fallback;
}

// Attributes and textures get what eval reads, also where the graph does not set them.
void resolve_slots(IrNode& node, const GraphNode& from, const CompileContext& context) {
  for (const SettingInfo& setting : node.type->settings) {
    if (setting.kind == SettingKind::attribute) {
      auto& slot = member<AttributeSlot>(node.data.get(), setting);
      const std::string base = slot.name;
      slot.name += setting.suffix;
      if (!context.attributes) continue;
      context.attributes->intern(base);  // what is derived must be there too
      slot.id = context.attributes->intern(slot.name);
    } else if (setting.kind == SettingKind::image) {
      auto& slot = member<ImageSlot>(node.data.get(), setting);
      if (slot.image >= 0 && context.texture)
        slot.texture = context.texture(slot.image, text_setting(from, "interpolation", "Linear"),
                                       text_setting(from, "extension", "REPEAT"));
    } else if (setting.kind == SettingKind::grid && context.grid) {
      auto& slot = member<GridSlot>(node.data.get(), setting);
      slot.grid = context.grid(slot.index);
    } else if (setting.kind == SettingKind::aov && context.aovs) {
      auto& slot = member<AovSlot>(node.data.get(), setting);
      const AovPass* pass = find_aov(*context.aovs, slot.name);
      if (pass) slot = {pass->name, pass->channel, pass->is_color};
    }
  }
}

// How a texture is sampled is settled by CompileContext::texture, whatever the node keeps of it.
bool is_texture_setting(const NodeType& type, const std::string& name) {
  if (name != "interpolation" && name != "extension") return false;
  return std::any_of(type.settings.begin(), type.settings.end(),
                     [](const SettingInfo& setting) { return setting.kind == SettingKind::image; });
}

void append_bytes(std::string& key, const void* bytes, size_t size) {
  key.append(static_cast<const char*>(bytes), size);
}

// Two nodes with the same key (and type) were given the same settings.
std::string key_of(const std::map<std::string, SettingValue>& settings) {
  std::string key;
  for (const auto& [name, value] : settings) {
    key += name;
    key += '\0';
    key += static_cast<char>(value.index());
    std::visit(
        [&key](const auto& held) {
          if constexpr (requires { held.data(); }) {
            const size_t bytes = held.size() * sizeof(held[0]);
            append_bytes(key, &bytes, sizeof bytes);
            append_bytes(key, held.data(), bytes);
          } else {
            append_bytes(key, &held, sizeof held);
          }
        },
        value);
  }
  return key;
}

std::string shown(const SettingValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const auto* i = std::get_if<int>(&value)) return std::to_string(*i);
  if (const auto* table = std::get_if<std::vector<float>>(&value))
    return std::string("[").append(std::to_string(table->size())).append("]");
  char text[32];
  std::snprintf(text, sizeof text, "%g", static_cast<double>(std::get<float>(value)));
  return text;
}

bool is_finite_value(const std::vector<float>& value) {
  return std::all_of(value.begin(), value.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

void apply_settings(IrNode& node, const GraphNode& from, const CompileContext& context) {
  for (const auto& [name, value] : from.settings) {
    bool known = is_texture_setting(*node.type, name), fits = true;
    for (const SettingInfo& setting : node.type->settings) {
      if (setting.name != name) continue;
      known = true;
      fits = assign(node.data.get(), setting, value);
    }
    if (!known)
      report(context, from.name, "setting '" + name + "' is unknown and ignored");
    else if (!fits)
      report(context, from.name,
             "setting '" + name + "' cannot be '" + shown(value) + "'; its default is used");
    if (!node.settings.empty()) node.settings += ", ";
    node.settings += shown(value);
  }
  node.settings_key = key_of(from.settings);
  resolve_slots(node, from, context);
  if (node.type->prepare) node.type->prepare(node.data.get());
}

void apply_inputs(IrNode& node, const GraphNode& from, const CompileContext& context) {
  for (const auto& [identifier, value] : from.inputs) {
    const InputInfo* input = node.type->input(identifier);
    if (!input) {
      report(context, from.name, "input '" + identifier + "' is unknown and ignored");
      continue;
    }
    if (input->type == SocketType::closure) continue;
    const bool fits = input->type == SocketType::number ? value.size() == 1
                                                        : value.size() == 3 || value.size() == 4;
    if (!fits || !is_finite_value(value)) {
      report(context, from.name,
             "input '" + identifier + "' has no usable value; its default is used");
      continue;
    }
    Constant constant{};
    std::copy_n(value.begin(), std::min<size_t>(value.size(), 3), constant.begin());
    set_constant(node.data.get(), *input, constant);
  }
}

}  // namespace tenniel
