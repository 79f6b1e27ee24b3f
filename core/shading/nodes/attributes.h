// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "shading/shading_context.h"

namespace tenniel {

class NodeRegistry;

// The mesh attribute `id` at the shaded point: 4 floats, a missing alpha 1; empty where the mesh
// lacks it or nothing is hit. Numbers are spread over the three channels.
std::optional<std::array<float, 4>> mesh_attribute(const ShadingContext& context, int id);

// The attribute `id` that this instance was given.
std::optional<std::array<float, 4>> instance_attribute(const ShadingContext& context, int id);

// What a simulation or a file left in this instance at the point: a colour is divided by its alpha.
// Empty on surfaces and where there is no such grid.
std::optional<std::array<float, 4>> grid_attribute(const ShadingContext& context, int id);
std::optional<std::array<float, 4>> grid_attribute(const Instance& instance, Vec3 point, float time,
                                                   int id, GridFilter filter);

// UV of the attribute `id`, or (0, 0, 0).
Vec3 uv_attribute(const ShadingContext& context, int id);

// Where a point of object space lies in the texture space of `instance`: [0, 1] inside.
Vec3 texture_space_coordinate(const Instance& instance, Vec3 point);

// The UV that an instancer gave to this instance.
Vec3 instancer_uv(const ShadingContext& context);

void register_attribute_nodes(NodeRegistry& registry);

}  // namespace tenniel
