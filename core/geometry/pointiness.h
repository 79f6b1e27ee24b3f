// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "math/cancellation.h"
#include "math/vec.h"

namespace tenniel {

// How far each vertex sticks out: the angle between its normal and the mean of its edges, over pi
// (0.5 is flat), averaged with the neighbours. Vertices in one place count as one. `edges` holds
// two vertices an edge.
std::vector<float> pointiness(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                              const std::vector<uint32_t>& edges,
                              const Cancellation& cancellation = {});

}  // namespace tenniel
