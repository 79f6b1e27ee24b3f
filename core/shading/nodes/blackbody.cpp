// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/blackbody.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/numeric.h"
#include "math/vec.h"

namespace tenniel {

namespace {

float lobe(float x, float centre, float below, float above) {
  const float t = (x - centre) * (x < centre ? below : above);
  return std::exp(-0.5f * t * t);
}

// Wyman, Sloan, Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions", the multi-lobe fit.
Vec3 color_matching(float nm) {
  return {
      1.056f * lobe(nm, 599.8f, 0.0264f, 0.0323f) + 0.362f * lobe(nm, 442.0f, 0.0624f, 0.0374f) -
          0.065f * lobe(nm, 501.1f, 0.0490f, 0.0382f),
      0.821f * lobe(nm, 568.8f, 0.0213f, 0.0247f) + 0.286f * lobe(nm, 530.9f, 0.0613f, 0.0322f),
      1.217f * lobe(nm, 437.0f, 0.0845f, 0.0278f) + 0.681f * lobe(nm, 459.0f, 0.0385f, 0.0725f)};
}

Spectrum xyz_to_rec709(Vec3 c) {
  return {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
          -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
          0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
}

}  // namespace

namespace {

constexpr float k_coldest = 800.0f, k_hottest = 12000.0f, k_step = 25.0f;

Spectrum positive(Spectrum c) {
  return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
}

Spectrum integrate_planck(float kelvin) {
  constexpr float k_second_radiation = 1.438776877e7f;  // nm K
  Vec3 xyz;
  for (float nm = 360.0f; nm <= 830.0f; nm += 5.0f) {
    // Planck's law; the constant in front falls out of the normalisation.
    const float x = nm * 1e-3f;
    const float radiance = 1.0f / (pow5(x) * std::expm1(k_second_radiation / (nm * kelvin)));
    xyz += color_matching(nm) * radiance;
  }
  return xyz_to_rec709(xyz / xyz.y);
}

std::vector<Spectrum> make_table() {
  std::vector<Spectrum> table;
  for (float kelvin = k_coldest; kelvin <= k_hottest; kelvin += k_step)
    table.push_back(integrate_planck(kelvin));
  return table;
}

}  // namespace

Spectrum blackbody_color(float kelvin) {
  static const std::vector<Spectrum> table = make_table();
  const float last = static_cast<float>(table.size() - 1);
  const float x = kelvin > k_coldest ? std::min((kelvin - k_coldest) / k_step, last) : 0.0f;
  const auto i = static_cast<size_t>(x), next = std::min(i + 1, table.size() - 1);
  return positive(lerp(table[i], table[next], x - static_cast<float>(i)));
}

Spectrum wavelength_color(float nm) {
  if (!(nm >= 380.0f && nm <= 780.0f)) return {};
  // The brightest wavelength comes out near 1.
  return positive(xyz_to_rec709(color_matching(nm)) * (1.0f / 2.52f));
}

}  // namespace tenniel
