// SPDX-License-Identifier: Apache-2.0
#include "image/colorspace.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tenniel {

namespace {

using Matrix = std::array<float, 9>;

// CIE XYZ (D65) to Rec.709: the inverse of the matrix in IEC 61966-2-1.
constexpr Matrix k_xyz_to_rec709 = {3.2404548f, -1.5371389f, -0.4985315f, -0.9692664f, 1.8760109f,
                                    0.0415561f, 0.0556434f,  -0.2040259f, 1.0572252f};
// The two ACES primaries of SMPTE ST 2065-1 and S-2014-004, white moved from D60 to D65 by
// Bradford.
constexpr Matrix k_ap0_to_rec709 = {2.5212854f,  -1.1339507f, -0.3874936f, -0.2764866f, 1.3727509f,
                                    -0.0962413f, -0.0153817f, -0.1530120f, 1.1686338f};
constexpr Matrix k_ap1_to_rec709 = {1.7047800f,  -0.6216933f, -0.0832457f, -0.1302596f, 1.1408311f,
                                    -0.0105485f, -0.0240091f, -0.1289999f, 1.1532490f};

const ColorSpace k_linear{};
const ColorSpace k_data{true, TransferCurve::linear, nullptr};
const ColorSpace k_srgb{false, TransferCurve::srgb, nullptr};
const ColorSpace k_rec709{false, TransferCurve::rec709, nullptr};
const ColorSpace k_filmic_log{false, TransferCurve::filmic_log, nullptr};
const ColorSpace k_xyz{false, TransferCurve::linear, &k_xyz_to_rec709};
const ColorSpace k_dci{false, TransferCurve::dci, &k_xyz_to_rec709};
const ColorSpace k_aces{false, TransferCurve::linear, &k_ap0_to_rec709};
const ColorSpace k_acescg{false, TransferCurve::linear, &k_ap1_to_rec709};

}  // namespace

const ColorSpace* find_colorspace(const std::string& name) {
  static const std::unordered_map<std::string, const ColorSpace*> spaces = {
      {"sRGB", &k_srgb},
      {"Linear", &k_linear},
      {"Linear Rec.709", &k_linear},
      {"Non-Color", &k_data},
      {"Raw", &k_data},
      {"", &k_data},
      {"nuke_rec709", &k_rec709},
      {"Filmic Log", &k_filmic_log},
      {"XYZ", &k_xyz},
      {"Linear CIE-XYZ D65", &k_xyz},
      {"dci_xyz", &k_dci},
      {"Linear ACES", &k_aces},
      {"ACES2065-1", &k_aces},
      {"Linear ACEScg", &k_acescg},
      {"ACEScg", &k_acescg},
  };
  const auto found = spaces.find(name);
  return found == spaces.end() ? nullptr : found->second;
}

float srgb_to_linear(float c) {
  if (c < 0.04045f) return std::max(c, 0.0f) * (1.0f / 12.92f);
  return std::pow((c + 0.055f) * (1.0f / 1.055f), 2.4f);
}

float linear_to_srgb(float c) {
  if (c < 0.0031308f) return std::max(c, 0.0f) * 12.92f;
  return 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

float decode_transfer(TransferCurve curve, float c) {
  switch (curve) {
    case TransferCurve::linear:
      return c;
    case TransferCurve::srgb:
      return srgb_to_linear(c);
    case TransferCurve::rec709:
      return c < 0.081f ? c * (1.0f / 4.5f)
                        : std::pow((c + 0.099f) * (1.0f / 1.099f), 1.0f / 0.45f);
    case TransferCurve::filmic_log:
      // 16.5 stops around middle grey, as Blender's configuration describes the space.
      return std::exp2(c * 16.5f - 12.473931188f);
    case TransferCurve::dci:
      // SMPTE ST 428-1: gamma 2.6, white at 48 of 52.37 cd/m^2.
      return 52.37f / 48.0f * std::pow(std::max(c, 0.0f), 2.6f);
  }
  return c;
}

void to_scene_linear(const ColorSpace& space, float* rgb) {
  if (space.curve != TransferCurve::linear)
    for (int i = 0; i < 3; ++i)
      rgb[i] = decode_transfer(space.curve, rgb[i]);
  if (!space.to_rec709) return;
  const Matrix& m = *space.to_rec709;
  const float r = rgb[0], g = rgb[1], b = rgb[2];
  for (size_t i = 0; i < 3; ++i)
    rgb[i] = m[3 * i] * r + m[3 * i + 1] * g + m[3 * i + 2] * b;
}

}  // namespace tenniel
