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

// What no register feeds is the same everywhere: the program itself says what it is.
bool is_constant(const ShaderIr& ir, uint8_t query) {
  const std::vector<ProgramStep> steps = order_steps(ir, query);
  return std::all_of(steps.begin(), steps.end(), [&ir](const ProgramStep& step) {
    if (step.node < 0) return false;
    const IrNode& node = ir.at(step.node);
    return node.type->is_closure() && !(node.type->varies && node.type->varies(node.data.get()));
  });
}

std::optional<GridMedium> find_grid_medium(const ShaderIr& ir, uint8_t query) {
  const std::vector<ProgramStep> steps = order_steps(ir, query);
  if (steps.size() != 1 || steps[0].node < 0) return {};
  const IrNode& node = ir.at(steps[0].node);
  return node.type->grid_medium ? node.type->grid_medium(node.data.get()) : std::nullopt;
}

void find_constant_emission(const ShaderIr& ir, ShaderDomain domain, Material& material) {
  material.is_emission_constant = is_constant(ir, k_query_emission);
  if (!material.is_emission_constant) return;
  ShadingContext context;
  context.reserve(material.emission.register_count());
  context.domain = domain;
  context.begin(k_query_emission);
  material.emission.run(context);
  material.constant_emission = context.emission;
}

void report_notes(const ShaderIr& ir, uint8_t query, const CompileContext& context) {
  for (const IrClosure& closure : closures_of_query(ir, query)) {
    const IrNode& node = ir.at(closure.node);
    const char* note = node.type->note ? node.type->note(node.data.get()) : nullptr;
    if (note) report(context, node.name, note);
  }
}

void find_subsurface(const ShaderIr& ir, Material& material) {
  for (const IrClosure& closure : closures_of_query(ir, k_query_scatter)) {
    const IrNode& node = ir.at(closure.node);
    if (!node.type->has_subsurface || !node.type->has_subsurface(node.data.get())) continue;
    material.has_subsurface = true;
    material.bends_subsurface |= ir.prologue >= 0;
    for (size_t i = 0; i < node.type->inputs.size(); ++i)
      material.bends_subsurface |=
          node.type->inputs[i].identifier == "Normal" && node.links[i].linked();
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

// From links as the artist made them to closures with weights.
void lower(ShaderIr& ir, const MaterialSource& source, ShaderRoot root,
           const CompileContext& context) {
  insert_conversions(ir, context);
  insert_implicit_inputs(ir, context);
  if (root == ShaderRoot::surface) insert_displacement(ir, source);
  lower_closures(ir);
  if (!context.optimise) return;
  fold_constants(ir, source.domain);
  share_equal_nodes(ir);
}

// True displacement is a program of its own; without BOTH nothing of it is left to bend normals.
void split_displacement(ShaderIr& ir, DisplacementMethod method, Material& material) {
  material.displacement_method = method;
  material.displaces = ir.prologue >= 0 && method != DisplacementMethod::bump;
  if (!material.displaces) return;
  const IrNode& bump = ir.at(ir.prologue);
  if (bump.links[0].linked()) {
    material.displacement = emit_vector(ir, bump.links[0]);
  } else {
    const Constant value = constant(bump.data.get(), input_info(*bump.type, 0));
    material.displacement.result.value = {value[0], value[1], value[2]};
  }
  if (method == DisplacementMethod::displacement) ir.prologue = -1;
}

// A node that serves both roots is built twice: it speaks once.
CompileContext reporting_once(const CompileContext& context) {
  CompileContext once = context;
  if (context.report)
    once.report = [said = std::make_shared<std::set<std::pair<std::string, std::string>>>(),
                   &context](const std::string& node, const std::string& text) {
      if (said->emplace(node, text).second) context.report(node, text);
    };
  return once;
}

void compile_volume(const MaterialSource& source, const CompileContext& context,
                    Material& material) {
  constexpr uint8_t k_query = k_query_volume | k_query_emission;
  ShaderIr ir = build_ir(source, context, ShaderRoot::volume);
  break_cycles(ir, context);
  lower(ir, source, ShaderRoot::volume, context);
  material.volume = emit_program(ir, k_query);
  material.has_volume = !material.volume.empty();
  report_notes(ir, k_query, context);
  material.is_volume_constant = is_constant(ir, k_query);
  material.grid_medium = find_grid_medium(ir, k_query);
  if (!material.is_volume_constant) return;
  ShadingContext shading;
  shading.reserve(material.volume.register_count());
  material.constant_volume = material.evaluate_volume(shading);
  if (material.constant_volume.is_vacuum()) material.has_volume = false;
}

}  // namespace

const MediumProperties& Material::evaluate_volume(ShadingContext& context) const {
  context.begin(k_query_volume | k_query_emission);
  volume.run(context);
  context.medium.add_emission(context.emission);
  return context.medium;
}

Material compile_material(const MaterialSource& source, CompileContext& given) {
  const CompileContext context = reporting_once(given);
  ShaderIr ir = build_ir(source, context);
  break_cycles(ir, context);
  Material material;
  if (source.domain == ShaderDomain::world) find_suns(ir, material);
  lower(ir, source, ShaderRoot::surface, context);
  split_displacement(ir, source.displacement, material);
  if (source.graph) material.name = source.graph->name;
  const uint8_t query = surface_query(source.domain);
  material.surface = emit_program(ir, query);
  material.emission = emit_program(ir, k_query_emission);
  if (query & k_query_transparency) material.transparency = emit_program(ir, k_query_transparency);
  material.aovs = emit_program(ir, k_query_aov);
  material.scatters = (query & k_query_scatter) && !closures_of_query(ir, k_query_scatter).empty();
  material.emits = !closures_of_query(ir, k_query_emission).empty();
  material.is_transparent = !material.transparency.empty();
  material.has_surface = ir.has_surface || !ir.has_volume;
  if (query & k_query_scatter) find_subsurface(ir, material);
  report_notes(ir, k_query_surface, context);
  find_constant_emission(ir, source.domain, material);
  if (material.is_emission_constant && is_black(material.constant_emission)) material.emits = false;
  if (ir.has_volume && source.domain != ShaderDomain::lamp)
    compile_volume(source, context, material);
  return material;
}

std::vector<std::string> required_tangents(const NodeGraph& graph) {
  std::set<std::string> names;
  for (const GraphNode& node : graph.nodes) {
    const std::string space = text_setting(node, "space");
    const bool from_map =
        node.type == "ShaderNodeNormalMap" && (space.empty() || space == "TANGENT");
    const bool from_vector =
        node.type == "ShaderNodeVectorDisplacement" && (space.empty() || space == "TANGENT");
    const bool from_uv =
        node.type == "ShaderNodeTangent" && text_setting(node, "direction_type") == "UV_MAP";
    if (from_map || from_vector || from_uv) names.insert(text_setting(node, "uv_map"));
  }
  return {names.begin(), names.end()};
}

}  // namespace tenniel
