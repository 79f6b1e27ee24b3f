// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace tenniel {

enum class AttributeDomain : uint8_t { vertex, corner, face };

// Named data on a mesh. `data` holds `channels` floats per element: 1 a number, 2 a UV, 3 a vector,
// 4 linear RGBA. `face` counts Blender's polygons, not the triangles or quads that are traced.
struct Attribute {
  std::string name;
  AttributeDomain domain = AttributeDomain::corner;
  uint8_t channels = 3;
  std::vector<float> data;
};

// Small ids for attribute names, so that a shader node finds its data without a string.
class AttributeIds {
 public:
  static constexpr int k_none = -1;
  // The id of `name`, made if new. Used while compiling only.
  int intern(const std::string& name);
  int find(const std::string& name) const;  // k_none if never interned
  int count() const { return static_cast<int>(ids_.size()); }

 private:
  std::unordered_map<std::string, int> ids_;
};

}  // namespace tenniel
