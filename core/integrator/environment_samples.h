// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lights/environment.h"
#include "math/spectrum.h"
#include "math/vec.h"
#include "scene/scene.h"

namespace tenniel {

// Toward a World: what a light sample of it needs.
struct alignas(32) EnvironmentSample {
  Vec3 wi;
  float pdf = 0.0f;  // per solid angle; 0: nothing is there
  Spectrum radiance;
};

// The one that `u` draws from `light`, of the World that `path` is in.
EnvironmentSample sample_environment(const Scene& scene, const EnvironmentLight& light,
                                     const PathInfo& path, Vec2 u, ShadingContext& scratch);

// Light samples of the Worlds, made once for a pass over the picture: a path takes one where it
// would search a map and run a shader (after Wyman and Panteleev 2021, "Rearchitecting
// Spatiotemporal Resampling for Production"). The unit square of numbers is cut into cells, and
// each cell's sample is drawn from a place within it: as even as the numbers themselves. All paths
// of a pass share them, which a pixel with far fewer samples than there are cells cannot tell; the
// next pass has others.
class EnvironmentSamples {
 public:
  static constexpr size_t k_side = 256;  // cells along a side
  static constexpr size_t k_count = k_side * k_side;

  // `first_sample` is the pass's; `rows` decides who does what, and changes no bit.
  EnvironmentSamples(const Scene& scene, uint32_t seed, uint32_t first_sample,
                     const RowLoop& rows = row_after_row);

  // Null where samples of that World must be made as they are needed.
  const EnvironmentSample* find(WorldIndex world, Vec2 u) const {
    const Table* table = tables_[world].get();
    return table ? &(*table)[cell_of(u.y) * k_side + cell_of(u.x)] : nullptr;
  }

 private:
  using Table = std::vector<EnvironmentSample>;  // (k_side, k_side), row 0 at u.y = 0

  static size_t cell_of(float u) { return static_cast<size_t>(u * static_cast<float>(k_side)); }

  // Null or, where Worlds look the same, one for all of them.
  std::array<std::shared_ptr<const Table>, k_world_count> tables_;
};

}  // namespace tenniel
