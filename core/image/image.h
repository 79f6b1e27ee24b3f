// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tenniel {

enum class AlphaMode : uint8_t { straight, premultiplied, channel_packed, none };

// Pixels as they stay in memory: bottom row first, `channels` interleaved. Bytes keep their encoding
// (sRGB is decoded after filtering, as Blender does); half and float hold scene-linear values.
struct Image {
  int width = 0, height = 0;
  int channels = 0;  // 1, 3 or 4 (2 becomes grey + alpha as 4)
  std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> pixels;
  bool is_half = false;          // the uint16_t are IEEE halves, not 16-bit integers
  bool is_srgb_encoded = false;  // bytes to decode after filtering
  bool is_associated = true;     // colour is multiplied by alpha
  size_t memory_bytes() const;
};

}  // namespace tenniel
