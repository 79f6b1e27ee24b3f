// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenniel {

// Coefficients of the sky of Hosek and Wilkie 2012, [X, Y, Z][albedo 0, 1][turbidity 1 to 10]
// [control point of a quintic over the cube root of the sun's elevation].
extern const float k_hosek_wilkie_shape[3][2][10][6][9];
extern const float k_hosek_wilkie_radiance[3][2][10][6];

}  // namespace tenniel
