// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "image/image.h"

namespace tenniel {

// No image of more bytes in memory is read.
constexpr size_t k_max_image_bytes = size_t{4} << 30;
constexpr int k_max_image_side = 1 << 16;

struct ImageLoadResult {
  std::shared_ptr<const Image> image;  // null when `error` is set
  std::string error;                   // one sentence that names the file
};

// Reads a PNG, JPEG, OpenEXR, Radiance HDR, TIFF, Targa, BMP, WebP or JPEG 2000 file; the content
// decides which it is (Targa has no signature: there the name does). Never throws. Refuses headers
// that promise more than the limits above or more pixels than a file of that size can hold.
ImageLoadResult load_image(const std::string& path, const ImageLoadOptions& options);

// Pixels that Blender handed over: `rgba` float32 (height, width, 4), bottom row first. Float
// images are scene-linear already; byte images come as encoded values in [0, 1] and are kept as
// bytes. `alpha_associated`: colour of a float image is multiplied by alpha; bytes never count as
// such, as in Cycles.
ImageLoadResult image_from_pixels(const float* rgba, int width, int height, bool is_float,
                                  bool alpha_associated, const ImageLoadOptions& options);

// Whether images in Blender's colour space `name` are converted exactly; others are read as sRGB.
bool colorspace_is_supported(const std::string& name);

// Writes float RGBA (height, width, 4), bottom row first, scene-linear with associated alpha, as
// EXR (32-bit) or PNG (8-bit sRGB, straight alpha) by extension. The file appears under its name
// only when complete. Returns an error sentence or an empty string.
std::string write_image(const std::string& path, const float* rgba, int width, int height);

// Version of the OpenImageIO library in use, e.g. "2.4.7".
std::string oiio_version();

}  // namespace tenniel
