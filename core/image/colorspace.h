// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tenniel {

enum class TransferCurve : uint8_t { linear, srgb, rec709, filmic_log, dci };

// How pixels of a named space of Blender's configuration become scene-linear Rec.709.
struct ColorSpace {
  bool is_data = false;  // numbers that are no colours: left alone
  TransferCurve curve = TransferCurve::linear;
  const std::array<float, 9>* to_rec709 = nullptr;  // rows, after decoding; null: same primaries
  bool is_scene_linear() const { return curve == TransferCurve::linear && !to_rec709; }
};

// Null for a name that is unknown or has no inverse here.
const ColorSpace* find_colorspace(const std::string& name);

float decode_transfer(TransferCurve curve, float encoded);
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

// In place, three channels.
void to_scene_linear(const ColorSpace& space, float* rgb);

}  // namespace tenniel
