// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/material.h"
#include "shading/shader_ir.h"

// The passes of compile_material in the order in which they run.
namespace tenniel {

inline void report(const CompileContext& context, const std::string& node,
                   const std::string& text) {
  if (context.report) context.report(node, text);
}

// The sockets of the output that make one program each.
enum class ShaderRoot : uint8_t { surface, volume };

// Nodes that the output's `root` needs, with their values and settings; what is unknown or of a
// wrong type is reported and left at its default.
ShaderIr build_ir(const MaterialSource& source, const CompileContext& context,
                  ShaderRoot root = ShaderRoot::surface);
// Drops each link that closes a cycle, with a report.
void break_cycles(ShaderIr& ir, const CompileContext& context);
// Makes each link join equal types, as Blender converts them; a value linked to a shader socket
// becomes an emission.
void insert_conversions(ShaderIr& ir, const CompileContext& context);
// Links the coordinates that Blender implies for inputs without a link.
void insert_implicit_inputs(ShaderIr& ir, const CompileContext& context);
// Lets what is linked to Displacement bend the shading normal.
void insert_displacement(ShaderIr& ir, const MaterialSource& source);
// Replaces Mix and Add Shader by a weight for each closure.
void lower_closures(ShaderIr& ir);
// Runs pure nodes on constants.
void fold_constants(ShaderIr& ir, ShaderDomain domain);
// Lets one of several equal nodes do for all.
void share_equal_nodes(ShaderIr& ir);

// Which closures a query keeps: those that add a part of it with a weight that is not always 0.
std::vector<IrClosure> closures_of_query(const ShaderIr& ir, uint8_t query);

// One step of a program to be: a node, or a jump over `skip` steps where `guard` is 0.
struct ProgramStep {
  int node = -1;
  IrLink guard;
  uint32_t skip = 0;
};
// Prunes what `query` does not need and puts the rest in order: nodes that only one branch of the
// tree needs come inside that branch, behind a jump over it.
std::vector<ProgramStep> order_steps(const ShaderIr& ir, uint8_t query);
// The steps that make one value.
std::vector<ProgramStep> order_steps(const ShaderIr& ir, IrLink value);
constexpr uint8_t k_every_query = 0xff;
// Whether a program for `query` reads this input while it runs (not: inside a node's own program).
bool is_read(const IrNode& node, size_t input, uint8_t query);

// Copies the nodes of `order_steps` into a Program and assigns its registers.
Program emit_program(const ShaderIr& ir, uint8_t query);
// The program of one value.
ProgramInput<Vec3> emit_vector(const ShaderIr& ir, IrLink value);

// Settings and values of one node (node_values.cpp).
void apply_settings(IrNode& node, const GraphNode& from, const CompileContext& context);
void apply_inputs(IrNode& node, const GraphNode& from, const CompileContext& context);

}  // namespace tenniel
