// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/description.h"

namespace tenniel {

// Whether the buffers of a struct are there and fit each other, so that the core may index them;
// what they hold is checked by the scene compiler. Raise Python's ValueError that names the field.
void check_sizes(const MeshDesc& mesh);
void check_sizes(const ImageDesc& image);
void check_sizes(const GridDesc& grid);

// `pixels` must hold width * height RGBA values. `owner` is named in the message.
void check_pixels(const Buffer<float>& pixels, int width, int height, const char* owner);

}  // namespace tenniel
