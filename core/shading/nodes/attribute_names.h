// SPDX-License-Identifier: Apache-2.0
#pragma once

// Names of attributes that no artist can type, and those the engine answers itself.
namespace tenniel {

// What the exporter puts in where UV Map and Color Attribute name nothing.
constexpr const char* k_active_uv = "";
constexpr const char* k_active_color = "\x01color";
// Vertices before deforming modifiers, in object space: what generated coordinates follow.
constexpr const char* k_undeformed = "\x01generated";

// A number for each polygon, the same all over a connected part.
constexpr const char* k_random_per_island = "\x01island";

// Attribute nodes of every type and tree: 0 on this side, 1 in a dream; and the world's index.
constexpr const char* k_behind_mirror = "behind_mirror";
constexpr const char* k_dream = "dream";

}  // namespace tenniel
