// SPDX-License-Identifier: Apache-2.0
#include "lights/light_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenniel {

LightSampler::LightSampler(const std::vector<Light>& all, WorldIndex world)
    : all_(&all), member_of_light_(all.size(), -1) {
  for (uint32_t i = 0; i < all.size(); ++i) {
    if (!all[i].visibility.exists_in(world)) continue;
    member_of_light_[i] = static_cast<int32_t>(members_.size());
    members_.push_back(i);
  }
  if (members_.size() <= k_max_weighed) {
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
  if (members_.size() > k_max_weighed) {
    if (by_power_.empty()) return {};
    const AliasTable::Choice choice = by_power_.sample(u);
    return LightChoice{members_[choice.index], choice.probability};
  }
  std::array<float, k_max_weighed> weights;
  float total = 0.0f;
  for (size_t i = 0; i < members_.size(); ++i)
    total += weights[i] = light_importance((*all_)[members_[i]], point);
  if (!(total > 0.0f)) return {};
  float target = u * total;
  size_t chosen = members_.size();
  for (size_t i = 0; i < members_.size(); ++i) {
    if (!(weights[i] > 0.0f)) continue;
    chosen = i;  // rounding may leave a rest behind the last: it stays the last
    if (target < weights[i]) break;
    target -= weights[i];
  }
  return LightChoice{members_[chosen], weights[chosen] / total};
}

float LightSampler::probability(const ShadingPoint& point, uint32_t light) const {
  const int32_t member = member_of_light_[light];
  if (member < 0) return 0.0f;
  if (members_.size() == 1) return 1.0f;
  if (members_.size() > k_max_weighed)
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
