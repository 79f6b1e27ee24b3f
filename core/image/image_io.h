// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "image/image.h"

namespace tenniel {

struct ImageLoadOptions {
  std::string colorspace = "sRGB";  // Blender's name; see `colorspace_is_supported`
  AlphaMode alpha = AlphaMode::straight;
  bool is_data = false;  // "Non-Color" and the like: no transform
  int size_limit = 0;    // longest side in pixels; 0 = none
};

struct ImageLoadResult {
  std::shared_ptr<const Image> image;  // null when `error` is set
  std::string error;                   // one sentence that names the file
};

// Reads a file by OpenImageIO. Never throws; refuses headers that promise more pixels than the file
// can hold or than `k_max_image_bytes`, and formats off the list of reliability (png, jpeg, exr,
// hdr, tiff, tga, bmp, webp, jpeg2000).
ImageLoadResult load_image(const std::string& path, const ImageLoadOptions& options);

// Pixels that Blender handed over: `rgba` (height, width, 4), bottom row first, straight or
// premultiplied as `alpha_associated` says. Float images are scene-linear already; byte images come
// as encoded values in [0, 1].
ImageLoadResult image_from_pixels(const float* rgba, int width, int height, bool is_float,
                                  bool alpha_associated, const ImageLoadOptions& options);

bool colorspace_is_supported(const std::string& name);

// Writes float RGBA (height, width, 4), bottom row first, as EXR or PNG by extension; the file
// appears under its name only when complete. Returns an error sentence or an empty string.
std::string write_image(const std::string& path, const float* rgba, int width, int height);

}  // namespace tenniel
