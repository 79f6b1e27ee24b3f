// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace tenniel {

enum class PassId : unsigned char { combined, depth, normal, mirror_world, mirror_coverage, dream };

// One table for the film, the bindings and the add-on.
struct PassInfo {
  PassId id;
  std::string_view name;  // Blender's name of the pass
  int channels;
  std::string_view channel_ids;  // Blender's letters
  bool is_averaged;              // false: holds what the first sample wrote
};

constexpr std::array<PassInfo, 6> k_passes = {{
    {PassId::combined, "Combined", 4, "RGBA", true},
    {PassId::depth, "Depth", 1, "Z", false},
    {PassId::normal, "Normal", 3, "XYZ", true},
    // The dream seen first, by itself or through mirrors and glass, and by how much of the pixel.
    {PassId::mirror_world, "Mirror World", 1, "X", false},
    {PassId::mirror_coverage, "Mirror Coverage", 1, "X", true},
    // What of Combined came through a looking glass.
    {PassId::dream, "Dream", 3, "RGB", true},
}};

}  // namespace tenniel
