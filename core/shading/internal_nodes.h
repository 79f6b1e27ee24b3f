// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/node_type.h"

// Nodes that only the compiler places; Blender does not know them, so they are in no registry.
namespace tenniel {

// Converts between two different value types as Blender does: colour to number by luminance,
// vector to number by mean, number to three equal parts, colour and vector by components.
const NodeType& conversion_node(SocketType from, SocketType to);

// inputs: weight, factor; outputs: weight * (1 - factor), weight * factor, factor kept in [0, 1].
const NodeType& mix_weights_node();
// inputs: a, b; output: a + b.
const NodeType& add_weights_node();
// input: displacement (a program, world space); bends the shading normal of the context.
// `is_displaced`: of a surface that has moved by it already.
const NodeType& displacement_bump_node(bool is_displaced);

}  // namespace tenniel
