// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "math/vec.h"

namespace tenniel {

constexpr float k_infinity = std::numeric_limits<float>::infinity();

// World space; `direction` is unit length, so `t` is a distance in metres.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float t_min = 0.0f;
  float t_max = k_infinity;
  float time = 0.0f;  // [0, 1] over the shutter
  // Metres behind `origin` where the ray was before it passed through a surface. Embree overlooks
  // ribbons nearer than two radii to where a ray starts; it is told of that place.
  float behind = 0.0f;

  Vec3 at(float t) const { return origin + direction * t; }
};

// Footprint of a sample along a path: a cone, `radius` wide where it starts.
struct RayCone {
  float radius = 0.0f;  // metres, at the ray's origin
  float spread = 0.0f;  // metres of radius per metre of distance
  float radius_at(float t) const { return radius + spread * t; }
};

}  // namespace tenniel
