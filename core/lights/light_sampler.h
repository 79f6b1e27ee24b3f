// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lights/light.h"

namespace tenniel {

struct LightChoice {
  uint32_t light = 0;  // index into the scene's lights
  float probability = 0.0f;
};

// Lights to look at from a point, of which one is to stand for all.
struct LightCandidates {
  static constexpr size_t k_max = 5;
  struct Candidate {
    uint32_t light = 0;           // index into the scene's lights
    float expected_count = 0.0f;  // of this light among the candidates
  };
  std::array<Candidate, k_max> lights;
  size_t count = 0;
  float fresh_u = 0.0f;  // what is left of the number, even and on its own; not of many lights
};

// Chooses lights of one world for a shading point. Few lights are weighed at the point itself; many
// by their power alone.
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
  // Those that may matter at the point. While lights are weighed each comes once at most, and `u`
  // decides on the faint ones; of many some are drawn.
  LightCandidates candidates(const ShadingPoint& point, float u) const {
    if (members_.size() == 1) return {{{{members_[0], 1.0f}}}, 1, u};
    return are_weighed() ? weighed_candidates(point, u) : drawn_candidates(u);
  }
  // How many of `candidates` are `light`, on average.
  float expected_count(const ShadingPoint& point, uint32_t light) const;
  bool are_weighed() const { return members_.size() <= k_max_weighed; }
  bool empty() const { return members_.empty(); }
  // Metres to the middle of the nearest light; infinite where none is near or there are too many to
  // look at each.
  float distance_to_nearest(Vec3 point) const;

 private:
  // Of the lights that are weighed, their importances and the sum of those.
  struct Weights {
    std::array<float, k_max_weighed> of;
    float total = 0.0f;
  };
  Weights weights_at(const ShadingPoint& point) const;
  LightCandidates weighed_candidates(const ShadingPoint& point, float u) const;
  LightCandidates drawn_candidates(float u) const;
  std::optional<LightChoice> choose_among_many(const ShadingPoint& point, float u) const;

  const std::vector<Light>* all_ = nullptr;
  std::vector<uint32_t> members_;
  std::vector<int32_t> member_of_light_;  // index in members_, -1 = not in this world
  AliasTable by_power_;                   // only when there are many
  std::vector<Vec3> centers_;             // of those at a finite distance, only when there are few
};

}  // namespace tenniel
