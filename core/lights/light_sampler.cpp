// SPDX-License-Identifier: Apache-2.0
#include "lights/light_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenniel {

namespace {

// How many lights a point looks at, about.
constexpr int k_looks = 4;
static_assert(k_looks < static_cast<int>(LightCandidates::k_max), "rounding may add one");

// At a light of a share of the importance of all.
float expected_looks(float share) {
  return std::min(k_looks * share, 1.0f);
}

}  // namespace

LightSampler::LightSampler(const std::vector<Light>& all, WorldIndex world)
    : all_(&all), member_of_light_(all.size(), -1) {
  for (uint32_t i = 0; i < all.size(); ++i) {
    if (!all[i].visibility.exists_in(world)) continue;
    member_of_light_[i] = static_cast<int32_t>(members_.size());
    members_.push_back(i);
  }
  if (are_weighed()) {
    for (const uint32_t light : members_)
      if (const auto center = center_of(all[light])) centers_.push_back(*center);
    return;
  }
  // A point one metre from each light: what is left of the importance is the power.
  std::vector<float> weights;
  weights.reserve(members_.size());
  for (const uint32_t light : members_) {
    ShadingPoint near{{}, {}, false};
    if (const auto* mesh = all[light].as<MeshLight>()) near.position = mesh->center();
    if (const auto* lamp = all[light].as<PointLight>()) near.position = lamp->position;
    if (const auto* spot = all[light].as<SpotLight>())
      near.position = spot->point.position + spot->axis;
    float beam = 1.0f;
    if (const auto* area = all[light].as<AreaLight>()) {
      near.position = area->center + area->normal;
      beam = area->beam_estimate(near.position);
    }
    weights.push_back(light_importance(all[light], near) / beam);
  }
  by_power_ = AliasTable(weights);
}

float LightSampler::distance_to_nearest(Vec3 point) const {
  float nearest_squared = k_infinity;
  for (const Vec3 center : centers_)
    nearest_squared = std::min(nearest_squared, length_squared(center - point));
  return std::sqrt(nearest_squared);
}

std::optional<LightChoice> LightSampler::choose_among_many(const ShadingPoint& point,
                                                           float u) const {
  if (members_.empty()) return {};
  if (!are_weighed()) {
    if (by_power_.empty()) return {};
    const AliasTable::Choice choice = by_power_.sample(u);
    return LightChoice{members_[choice.index], choice.probability};
  }
  const Weights weights = weights_at(point);
  if (!(weights.total > 0.0f)) return {};
  float target = u * weights.total;
  size_t chosen = members_.size();
  for (size_t i = 0; i < members_.size(); ++i) {
    if (!(weights.of[i] > 0.0f)) continue;
    chosen = i;  // rounding may leave a rest behind the last: it stays the last
    if (target < weights.of[i]) break;
    target -= weights.of[i];
  }
  return LightChoice{members_[chosen], weights.of[chosen] / weights.total};
}

LightSampler::Weights LightSampler::weights_at(const ShadingPoint& point) const {
  Weights weights;
  for (size_t i = 0; i < members_.size(); ++i)
    weights.total += weights.of[i] = light_importance((*all_)[members_[i]], point);
  return weights;
}

LightCandidates LightSampler::drawn_candidates(float u) const {
  LightCandidates drawn;
  if (by_power_.empty()) return drawn;
  for (int i = 0; i < k_looks; ++i) {
    const AliasTable::Choice choice = by_power_.sample((static_cast<float>(i) + u) / k_looks);
    drawn.lights[drawn.count++] = {members_[choice.index], k_looks * choice.probability};
  }
  return drawn;
}

// Systematic sampling: a light is drawn where the running sum of the counts, begun at `u`, passes a
// whole number. Between `low` and `high` every `u` draws the same.
LightCandidates LightSampler::weighed_candidates(const ShadingPoint& point, float u) const {
  LightCandidates drawn;
  const Weights weights = weights_at(point);
  if (!(weights.total > 0.0f)) return drawn;
  float sum = 0.0f, low = 0.0f, high = 1.0f;
  for (size_t i = 0; i < members_.size(); ++i) {
    const float count = expected_looks(weights.of[i] / weights.total);
    const bool is_drawn = std::floor(sum + count + u) > std::floor(sum + u);
    sum += count;
    if (is_drawn && drawn.count < LightCandidates::k_max)
      drawn.lights[drawn.count++] = {members_[i], count};
    const float next = std::floor(sum) + 1.0f - sum;
    if (next <= u)
      low = std::max(low, next);
    else
      high = std::min(high, next);
  }
  drawn.fresh_u = std::min((u - low) / (high - low), k_one_minus_epsilon);
  return drawn;
}

float LightSampler::expected_count(const ShadingPoint& point, uint32_t light) const {
  const float share = probability(point, light);
  return are_weighed() ? expected_looks(share) : k_looks * share;
}

float LightSampler::probability(const ShadingPoint& point, uint32_t light) const {
  const int32_t member = member_of_light_[light];
  if (member < 0) return 0.0f;
  if (members_.size() == 1) return 1.0f;
  if (!are_weighed())
    return by_power_.empty() ? 0.0f : by_power_.probability(static_cast<uint32_t>(member));
  float total = 0.0f, own = 0.0f;
  for (const uint32_t i : members_) {
    const float weight = light_importance((*all_)[i], point);
    total += weight;
    if (i == light) own = weight;
  }
  return total > 0.0f ? own / total : 0.0f;
}

}  // namespace tenniel
