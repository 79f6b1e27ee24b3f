// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tenniel {

// `premultiplied` is treated as `straight`: what the file says of its alpha decides.
enum class AlphaMode : uint8_t { straight, premultiplied, channel_packed, none };

// Pixels as they stay in memory: bottom row first, `channels` interleaved. Pixels of an sRGB file
// keep their encoding and are decoded after filtering, as Cycles does; all others are scene-linear
// or data.
struct Image {
  int width = 0, height = 0;
  int channels = 0;  // 1, 3 or 4
  std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> pixels;
  bool is_half = false;          // the uint16_t are IEEE halves, not 16-bit integers
  bool is_srgb_encoded = false;  // to be decoded after filtering
  bool is_associated = true;     // colour is multiplied by alpha
  size_t memory_bytes() const;
};

struct ImageLoadOptions {
  std::string colorspace = "sRGB";  // Blender's name; an unknown one counts as sRGB
  AlphaMode alpha = AlphaMode::straight;
  bool is_data = false;  // "Non-Color" and the like: no transform
  int size_limit = 0;    // longest side in pixels; 0 = none
};

// Turns the pixels of a file (1 to 4 channels, still in the encoding and alpha state of the file)
// into an Image as above: expands grey + alpha, converts to scene-linear, associates alpha, clears
// non-finite values and halves the size until it is within the limit.
// `file_is_associated`: colour in `raw` is already multiplied by alpha.
Image prepare_image(Image raw, bool file_is_associated, const ImageLoadOptions& options);

}  // namespace tenniel
