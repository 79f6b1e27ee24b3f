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

// A number for each vertex: how far it sticks out. The exporter sends the vertex normals in its
// place.
constexpr const char* k_pointiness = "\x01pointiness";

// Of hairs: on keys the way from the root as a part of the whole, on hairs that. Of hairs and
// points a number that tells them apart.
constexpr const char* k_strand_intercept = "\x01intercept";
constexpr const char* k_strand_length = "\x01length";
constexpr const char* k_strand_random = "\x01strand:random";

// Of an instance that stands for a particle: (index, age, lifetime, size), and vectors.
constexpr const char* k_particle_numbers = "\x01particle:numbers";
constexpr const char* k_particle_location = "\x01particle:location";
constexpr const char* k_particle_velocity = "\x01particle:velocity";
constexpr const char* k_particle_angular_velocity = "\x01particle:angular_velocity";

// Attribute nodes of every type and tree: 0 on this side, 1 in a dream; and the world's index.
constexpr const char* k_behind_mirror = "behind_mirror";
constexpr const char* k_dream = "dream";

}  // namespace tenniel
