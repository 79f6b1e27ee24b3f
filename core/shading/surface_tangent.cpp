// SPDX-License-Identifier: Apache-2.0
#include "shading/surface_tangent.h"

#include <cmath>

#include "math/numeric.h"

namespace tenniel {

Vec3 generated_coordinates(const SurfaceInteraction& surface) {
  if (!surface.instance) return surface.position;
  const Instance& instance = *surface.instance;
  const Vec3 p = surface.world_to_object().point(undisplaced_position(surface)) -
                 instance.texture_space_location;
  const Vec3 size = instance.texture_space_size;
  const auto scaled = [](float x, float half) { return safe_divide(x, 2.0f * half) + 0.5f; };
  return {scaled(p.x, size.x), scaled(p.y, size.y), scaled(p.z, size.z)};
}

Vec3 surface_tangent(const SurfaceInteraction& surface, Vec3 normal) {
  const Vec3 g = generated_coordinates(surface);
  const Vec3 around{-(g.y - 0.5f), g.x - 0.5f, 0.0f};
  const Vec3 world = surface.instance ? normal_to_world(surface, around) : around;
  return cross(normal, normalize_or(cross(world, normal), {}));
}

Vec3 rotate_about(Vec3 v, Vec3 axis, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0f - c));
}

}  // namespace tenniel
