// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "bsdf/bsdf.h"
#include "integrator/path_state.h"
#include "scene/description.h"

// When a path ends, and what bounds a contribution: Cycles' rules, so that a file's settings mean
// the same here.
namespace tenniel {

inline RayKind ray_kind_of(LobeClass lobe) {
  return lobe == LobeClass::diffuse  ? RayKind::diffuse
         : lobe == LobeClass::glossy ? RayKind::glossy
                                     : RayKind::transmission;
}

// Counts a bounce and notes when one of the limits lets only transparent surfaces follow.
inline void count_bounce(PathState& state, const BsdfSample& sample, const RenderSettings& limits) {
  PathInfo& info = state.info;
  bool reached = ++info.ray_depth > limits.max_bounces;
  switch (sample.lobe_class) {
    case LobeClass::diffuse:
      reached |= ++info.diffuse_depth > limits.diffuse_bounces;
      break;
    case LobeClass::glossy:
      reached |= ++info.glossy_depth > limits.glossy_bounces;
      break;
    case LobeClass::transmission:
      reached |= ++info.transmission_depth > limits.transmission_bounces;
      break;
    case LobeClass::transparent:
      break;
  }
  info.kind = ray_kind_of(sample.lobe_class);
  info.is_singular = sample.is_delta;
  info.is_reflection = sample.lobe_class != LobeClass::transmission;
  info.is_diffuse = sample.is_diffuse;
  info.has_diffuse_ancestor |= sample.is_diffuse;
  state.ends_after_transparent |= reached;
  state.sees_background = false;
  state.is_specular_so_far &= sample.is_delta;
}

// The same for scattering in a medium.
inline void count_volume_bounce(PathState& state, const RenderSettings& limits) {
  PathInfo& info = state.info;
  bool reached = ++info.ray_depth > limits.max_bounces;
  reached |= ++info.volume_depth > limits.volume_bounces;
  info.kind = RayKind::volume_scatter;
  info.is_singular = info.is_reflection = info.is_diffuse = false;
  state.ends_after_transparent |= reached;
  state.sees_background = false;
  state.is_specular_so_far = false;
}

// Whether the transparent surfaces are used up: what lies behind the last one may only emit.
inline bool sees_emission_only(const PathState& state, const RenderSettings& limits) {
  return state.info.transparent_depth > limits.transparent_max_bounces;
}

// Paths live at full strength until their throughput falls to a half, then in proportion to it.
// Measured in a closed room at equal noise: 0.87 of the time that the square root of the throughput
// takes, whose deaths cost more noise than the rays they save. The first bounce is spared: what a
// dark material reflects would be noise.
constexpr float k_worthwhile_throughput = 2.0f;

// Probability of going on after a bounce.
inline float survival_probability(const PathState& state, const RenderSettings& limits) {
  if (state.info.ray_depth <= limits.min_light_bounces + 1) return 1.0f;
  return std::min(k_worthwhile_throughput * max_component(state.throughput), 1.0f);
}

// Scales a contribution so that the sum of its channels stays below three times the limit; 0 =
// none.
inline Spectrum clamped(Spectrum contribution, int bounces, const RenderSettings& limits) {
  const float limit = 3.0f * (bounces > 0 ? limits.clamp_indirect : limits.clamp_direct);
  const float sum = std::abs(contribution.r) + std::abs(contribution.g) + std::abs(contribution.b);
  return limit > 0.0f && sum > limit ? contribution * (limit / sum) : contribution;
}

// Alpha that glossy lobes take at least, after a bounce as unlikely as `min_pdf` (filter glossy).
inline float filter_glossy_alpha(float min_pdf, const RenderSettings& limits) {
  if (limits.blur_glossy <= 0.0f) return 0.0f;
  const float blur_pdf = min_pdf / limits.blur_glossy;
  return blur_pdf < 1.0f ? std::sqrt(1.0f - blur_pdf) * 0.5f : 0.0f;
}

}  // namespace tenniel
