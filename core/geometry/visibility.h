// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tenniel {

// World 0 is this side; 1..4 are the dreams behind looking glasses.
using WorldIndex = uint8_t;
constexpr int k_world_count = 5;

// What a ray was sent for: the last event of its path that was not a transparent pass-through.
enum class RayKind : uint8_t { camera, diffuse, glossy, transmission, volume_scatter, shadow };
constexpr int k_ray_kind_count = 6;
static_assert(k_world_count * k_ray_kind_count <= 32, "one bit each in Embree's 32-bit mask");

// The Embree mask of a ray: one bit. An object is hit where its `Visibility` holds that bit.
constexpr uint32_t ray_mask(WorldIndex world, RayKind kind) {
  return 1u << (static_cast<uint32_t>(world) * k_ray_kind_count + static_cast<uint32_t>(kind));
}

// Hits whatever exists in a world, by whatever ray.
constexpr uint32_t any_ray_mask(WorldIndex world) {
  return 0x3fu << (static_cast<uint32_t>(world) * k_ray_kind_count);
}

// In which worlds, and by which kinds of ray, a thing is seen.
struct Visibility {
  uint32_t bits = (1u << (k_world_count * k_ray_kind_count)) - 1u;

  // `worlds`: bit w for world w. `kinds`: bit k for RayKind k.
  static constexpr Visibility from_sets(uint32_t worlds, uint32_t kinds) {
    Visibility v{0};
    for (uint32_t w = 0; w < k_world_count; ++w)
      if (worlds >> w & 1u) v.bits |= (kinds & 0x3fu) << (w * k_ray_kind_count);
    return v;
  }
  constexpr bool seen_by(WorldIndex world, RayKind kind) const {
    return (bits & ray_mask(world, kind)) != 0;
  }
  constexpr bool exists_in(WorldIndex world) const {
    return (bits >> (static_cast<uint32_t>(world) * k_ray_kind_count) & 0x3fu) != 0;
  }
};

}  // namespace tenniel
