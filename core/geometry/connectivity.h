// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// What only the edges of a mesh tell. `edges` holds two vertices an edge; those out of range are
// ignored.
namespace tenniel {

// For each vertex the one that stands for its connected part. Which one is hashed into Random Per
// Island, so it is Blender's: union by rank, edge by edge, the first vertex winning a tie.
std::vector<uint32_t> connected_parts(size_t vertex_count, const std::vector<uint32_t>& edges);

// Values of edges (`channels` floats each) as means at the vertices; 0 where no edge ends.
std::vector<float> edges_to_vertices(size_t vertex_count, const std::vector<uint32_t>& edges,
                                     const std::vector<float>& values, size_t channels);

}  // namespace tenniel
