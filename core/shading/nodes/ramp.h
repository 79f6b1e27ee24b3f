// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "math/numeric.h"

namespace tenniel {

// Reads a table of `channels` floats an entry, baked at i / (entries - 1), at `position`.
// `interpolate` false: the entry at or before it. `extrapolate` continues the first or last segment
// as a line, as curves do; ramps hold their ends. An empty table reads as 0.
template <size_t channels>
std::array<float, channels> lookup_table(const std::vector<float>& table, float position,
                                         bool interpolate, bool extrapolate) {
  std::array<float, channels> result{};
  const size_t entries = table.size() / channels;
  if (entries == 0) return result;
  const float last = static_cast<float>(entries - 1);
  const float x = position > 0.0f ? std::min(position * last, last) : 0.0f;
  const size_t i = static_cast<size_t>(x), next = std::min(i + 1, entries - 1);
  const float t = interpolate ? x - static_cast<float>(i) : 0.0f;
  for (size_t c = 0; c < channels; ++c)
    result[c] = lerp(table[i * channels + c], table[next * channels + c], t);
  if (!extrapolate || entries < 2 || (position >= 0.0f && position <= 1.0f)) return result;
  const size_t end = position < 0.0f ? 0 : entries - 1, inner = position < 0.0f ? 1 : entries - 2;
  const float beyond = position < 0.0f ? -position : position - 1.0f;
  for (size_t c = 0; c < channels; ++c) {
    const float slope = table[end * channels + c] - table[inner * channels + c];
    result[c] = table[end * channels + c] + slope * beyond * last;
  }
  return result;
}

class NodeRegistry;
void register_ramp_nodes(NodeRegistry& registry);

}  // namespace tenniel
