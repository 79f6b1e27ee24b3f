// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "lights/light.h"

namespace tenniel {

struct LightChoice {
  uint32_t light = 0;  // index into the scene's lights
  float probability = 0.0f;
};

// Chooses a light of one world for a shading point. Few lights are weighed at the point itself;
// many by their power alone.
class LightSampler {
 public:
  static constexpr size_t k_max_weighed = 48;

  LightSampler() = default;
  // The lights of `all` that exist in `world`. `all` must outlive the sampler.
  LightSampler(const std::vector<Light>& all, WorldIndex world);

  // Empty when no light can reach the point.
  std::optional<LightChoice> choose(const ShadingPoint& point, float u) const {
    if (members_.size() == 1) return LightChoice{members_[0], 1.0f};
    return choose_among_many(point, u);
  }
  // Probability that `choose` returns `light` at `point`.
  float probability(const ShadingPoint& point, uint32_t light) const;
  bool empty() const { return members_.empty(); }
  // Metres to the middle of the nearest light; infinite where none is near or there are too many to
  // look at each.
  float distance_to_nearest(Vec3 point) const;

 private:
  std::optional<LightChoice> choose_among_many(const ShadingPoint& point, float u) const;

  const std::vector<Light>* all_ = nullptr;
  std::vector<uint32_t> members_;
  std::vector<int32_t> member_of_light_;  // index in members_, -1 = not in this world
  AliasTable by_power_;                   // only when there are many
  std::vector<Vec3> centers_;             // of those at a finite distance, only when there are few
};

}  // namespace tenniel
