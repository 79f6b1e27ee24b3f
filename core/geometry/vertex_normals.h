// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace tenniel {

// The normal of each vertex as Blender defines it: those of the polygons around, each by its angle
// there; away from the origin where there is none. Blender's own sums go in the order in which its
// threads come along, so that they differ in the last bits from one render to the next.
std::vector<Vec3> vertex_normals(const PolygonSoup& soup, const Cancellation& cancellation = {});

// Corners without a sharp edge take over the normals of their vertices in Blender, with those last
// bits: here they are given `of_vertices` instead.
void settle_corner_normals(const PolygonSoup& soup, const std::vector<Vec3>& of_vertices,
                           std::vector<Vec3>& of_corners);

}  // namespace tenniel
