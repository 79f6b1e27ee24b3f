// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenniel {

// A pass of the artist's own, which AOV Output nodes of that name write: where its floats stand
// among those of a sample.
struct AovPass {
  std::string name;
  bool is_color = false;
  int channel = 0;

  // A colour's fourth says how often it was written.
  int channels() const { return is_color ? 4 : 1; }
};

inline const AovPass* find_aov(const std::vector<AovPass>& aovs, const std::string& name) {
  for (const AovPass& aov : aovs)
    if (aov.name == name) return &aov;
  return nullptr;
}

inline int aov_channels(const std::vector<AovPass>& aovs) {
  return aovs.empty() ? 0 : aovs.back().channel + aovs.back().channels();
}

}  // namespace tenniel
