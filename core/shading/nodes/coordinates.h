// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/transform.h"
#include "math/vec.h"

namespace tenniel {

enum class MappingType : uint8_t { point, texture, vector, normal };

// The Mapping node; `turn`: by the angles of its Rotation.
Vec3 map_vector(MappingType type, Vec3 v, Vec3 location, const Transform& turn, Vec3 scale);

// The mapping that every texture node carries, as the exporter bakes it: nothing (identity), or 12
// floats (three rows of an affine map), or 18 with the lower and upper bounds of the result.
Vec3 apply_texture_mapping(const std::vector<float>& mapping, Vec3 v);

// Pictures around an object: `p` as the Image Texture node takes it, in [0, 1]^3.
Vec2 sphere_projection(Vec3 p);
Vec2 tube_projection(Vec3 p);
// Pictures around the viewer; `direction` need not be unit length, zero gives (0, 0).
Vec2 equirectangular_projection(Vec3 direction);
Vec2 mirror_ball_projection(Vec3 direction);

// How much each face pair (x, y, z) of a box shows at a normal; sums to 1. `blend` in [0, 1].
Vec3 box_weights(Vec3 normal, float blend);
// Where the picture of face pair `axis` is read: never mirrored for the one who looks at it.
Vec2 box_projection(Vec3 p, Vec3 normal, int axis);

}  // namespace tenniel
