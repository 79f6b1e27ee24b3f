// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/interaction.h"

namespace tenniel {

// Generated coordinates of the point: [0, 1] over the texture space of its object.
Vec3 generated_coordinates(const SurfaceInteraction& surface);

// Blender's tangent where none is given: around the object's Z axis, perpendicular to `normal`.
// Unit length; zero where it has no direction.
Vec3 surface_tangent(const SurfaceInteraction& surface, Vec3 normal);

// `v` turned by `angle` radians about the unit `axis` (Rodrigues).
Vec3 rotate_about(Vec3 v, Vec3 axis, float angle);

}  // namespace tenniel
