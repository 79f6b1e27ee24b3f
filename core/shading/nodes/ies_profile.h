// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "math/vec.h"

namespace tenniel {

// Intensity of a luminaire over directions, from the text of an IES file (LM-63) of photometric
// type B or C.
class IesProfile {
 public:
  // What Blender shows where a file cannot be used.
  static constexpr float k_unusable = 100.0f;

  // An unusable text gives a profile of k_unusable everywhere.
  explicit IesProfile(const std::string& text);
  bool is_usable() const { return !intensity_.empty(); }
  // Along `direction`, which counts from -Z; watts of a lamp that shines alike to all sides.
  float intensity(Vec3 direction) const;

 private:
  bool parse(const std::string& text);
  bool complete_type_b();
  bool complete_type_c();
  float at_vertical(size_t h, size_t v, float t) const;

  std::vector<float> horizontal_, vertical_;   // angles, radians; the first over the full circle
  std::vector<std::vector<float>> intensity_;  // [horizontal][vertical]
};

}  // namespace tenniel
