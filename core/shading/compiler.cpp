// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "shading/compiler_passes.h"
#include "shading/material.h"

namespace tenniel {
namespace {

// What a domain can show: a World and a lamp have no surface to scatter at.
uint8_t surface_query(ShaderDomain domain) {
  return domain == ShaderDomain::surface ? k_query_surface : k_query_emission;
}

// Emission that no register feeds is the same everywhere; the program itself says what it is.
void find_constant_emission(const ShaderIr& ir, ShaderDomain domain, Material& material) {
  const std::vector<ProgramStep> steps = order_steps(ir, k_query_emission);
  material.is_emission_constant =
      std::all_of(steps.begin(), steps.end(), [&ir](const ProgramStep& step) {
        return step.node >= 0 && ir.at(step.node).type->is_closure();
      });
  if (!material.is_emission_constant) return;
  ShadingContext context;
  context.reserve(material.emission.register_count());
  context.domain = domain;
  context.begin(k_query_emission);
  material.emission.run(context);
  material.constant_emission = context.emission;
}

void report_notes(const ShaderIr& ir, const CompileContext& context) {
  for (const IrClosure& closure : closures_of_query(ir, k_query_surface)) {
    const IrNode& node = ir.at(closure.node);
    const char* note = node.type->note ? node.type->note(node.data.get()) : nullptr;
    if (note) report(context, node.name, note);
  }
}

// Before implicit inputs are linked: a sky that is asked for plain directions shows its sun where
// it says.
void find_suns(const ShaderIr& ir, Material& material) {
  for (const IrNode& node : ir.nodes) {
    const auto sun = node.type->sun_disk ? node.type->sun_disk(node.data.get()) : std::nullopt;
    if (!sun) continue;
    const IrLink link = node.links.empty() ? IrLink() : node.links.front();
    const NodeType* source = link.linked() ? ir.at(link.node).type : nullptr;
    const bool is_plain =
        !source || (source->idname == "ShaderNodeTexCoord" &&
                    source->outputs[static_cast<size_t>(link.output)].identifier == "Generated");
    if (is_plain)
      material.suns.push_back(*sun);
    else
      material.has_hidden_sun = true;
  }
}

std::string text_setting(const GraphNode& node, const char* name) {
  const auto it = node.settings.find(name);
  const auto* text = it == node.settings.end() ? nullptr : std::get_if<std::string>(&it->second);
  return text ? *text : std::string();
}

}  // namespace

Material compile_material(const MaterialSource& source, CompileContext& context) {
  ShaderIr ir = build_ir(source, context);
  break_cycles(ir, context);
  Material material;
  if (source.domain == ShaderDomain::world) find_suns(ir, material);
  insert_conversions(ir, context);
  insert_implicit_inputs(ir, context);
  insert_displacement(ir, source, context);
  lower_closures(ir);
  if (context.optimise) {
    fold_constants(ir, source.domain);
    share_equal_nodes(ir);
  }
  if (source.graph) material.name = source.graph->name;
  const uint8_t query = surface_query(source.domain);
  material.surface = emit_program(ir, query);
  material.emission = emit_program(ir, k_query_emission);
  if (query & k_query_transparency) material.transparency = emit_program(ir, k_query_transparency);
  material.scatters = (query & k_query_scatter) && !closures_of_query(ir, k_query_scatter).empty();
  material.emits = !closures_of_query(ir, k_query_emission).empty();
  material.is_transparent = !material.transparency.empty();
  material.has_surface = ir.has_surface || !ir.has_volume;
  report_notes(ir, context);
  find_constant_emission(ir, source.domain, material);
  if (material.is_emission_constant && is_black(material.constant_emission)) material.emits = false;
  return material;
}

std::vector<std::string> required_tangents(const NodeGraph& graph) {
  std::set<std::string> names;
  for (const GraphNode& node : graph.nodes) {
    const std::string space = text_setting(node, "space");
    const bool from_map =
        node.type == "ShaderNodeNormalMap" && (space.empty() || space == "TANGENT");
    const bool from_uv =
        node.type == "ShaderNodeTangent" && text_setting(node, "direction_type") == "UV_MAP";
    if (from_map || from_uv) names.insert(text_setting(node, "uv_map"));
  }
  return {names.begin(), names.end()};
}

}  // namespace tenniel
