// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/blackbody.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/vec.h"

namespace tenniel {

namespace {

Spectrum xyz_to_rec709(Vec3 c) {
  return {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
          -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
          0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
}

// Blender's fit of Planck's law under the CIE 1931 observer, whose coefficients are its definition
// of the colour: red and green a / T + b T + c, blue a cubic of T, up to `hottest` kelvin.
struct BlackbodyFit {
  float hottest;
  std::array<float, 3> red, green;
  std::array<float, 4> blue;
};
constexpr std::array<BlackbodyFit, 7> k_blackbody_fits = {{
    {965.0f,
     {1.61919106e3f, -2.05010916e-3f, 5.02995757f},
     {-4.88999748e2f, 6.04330754e-4f, -7.55807526e-2f},
     {5.96945309e-11f, -4.85742887e-8f, -9.70622247e-5f, -4.07936148e-3f}},
    {1167.0f,
     {2.48845471e3f, -1.11330907e-3f, 3.22621544f},
     {-7.55994277e2f, 3.16730098e-4f, 4.78306139e-1f},
     {2.40430366e-11f, 5.55021075e-8f, -1.98503712e-4f, 2.89312858e-2f}},
    {1449.0f,
     {3.34143193e3f, -4.86551192e-4f, 1.76486769f},
     {-1.02363977e3f, 1.20223470e-4f, 9.36662319e-1f},
     {-1.40949732e-11f, 1.89878968e-7f, -3.56632824e-4f, 9.10767778e-2f}},
    {1902.0f,
     {4.09461742e3f, -1.27446582e-4f, 7.25731635e-1f},
     {-1.26571316e3f, 4.87340896e-6f, 1.27054498f},
     {-3.61460868e-11f, 2.84822009e-7f, -4.93211319e-4f, 1.56723440e-1f}},
    {3315.0f,
     {4.67028036e3f, 2.91258199e-5f, 1.26703442e-1f},
     {-1.42529332e3f, -4.01150431e-5f, 1.43972784f},
     {-1.97075738e-11f, 1.75359352e-7f, -2.50542825e-4f, -2.22783266e-2f}},
    {6365.0f,
     {4.59509185e3f, 2.87495649e-5f, 1.50345020e-1f},
     {-1.17554822e3f, -2.16378048e-5f, 1.30408023f},
     {-1.61997957e-13f, -1.64216008e-8f, 3.86216271e-4f, -7.38077418e-1f}},
    {12000.0f,
     {3.78717450e3f, 9.35907826e-6f, 3.99075871e-1f},
     {-5.00799571e2f, -4.59832026e-6f, 1.09098763f},
     {6.72650283e-13f, -2.73078809e-8f, 4.24098264e-4f, -7.52335691e-1f}},
}};
constexpr float k_coldest = 800.0f;
constexpr Spectrum k_coldest_color{5.4132945f, 0.0f, 0.0f};
constexpr Spectrum k_hottest_color{0.82629548f, 0.99450805f, 1.56630771f};

// Colour matching functions of the CIE 1931 observer, 380 to 780 nm by 5.
constexpr float k_first_nm = 380.0f, k_step_nm = 5.0f;
constexpr std::array<Vec3, 81> k_color_matching = {{
    {0.0014f, 0.0000f, 0.0065f}, {0.0022f, 0.0001f, 0.0105f}, {0.0042f, 0.0001f, 0.0201f},
    {0.0076f, 0.0002f, 0.0362f}, {0.0143f, 0.0004f, 0.0679f}, {0.0232f, 0.0006f, 0.1102f},
    {0.0435f, 0.0012f, 0.2074f}, {0.0776f, 0.0022f, 0.3713f}, {0.1344f, 0.0040f, 0.6456f},
    {0.2148f, 0.0073f, 1.0391f}, {0.2839f, 0.0116f, 1.3856f}, {0.3285f, 0.0168f, 1.6230f},
    {0.3483f, 0.0230f, 1.7471f}, {0.3481f, 0.0298f, 1.7826f}, {0.3362f, 0.0380f, 1.7721f},
    {0.3187f, 0.0480f, 1.7441f}, {0.2908f, 0.0600f, 1.6692f}, {0.2511f, 0.0739f, 1.5281f},
    {0.1954f, 0.0910f, 1.2876f}, {0.1421f, 0.1126f, 1.0419f}, {0.0956f, 0.1390f, 0.8130f},
    {0.0580f, 0.1693f, 0.6162f}, {0.0320f, 0.2080f, 0.4652f}, {0.0147f, 0.2586f, 0.3533f},
    {0.0049f, 0.3230f, 0.2720f}, {0.0024f, 0.4073f, 0.2123f}, {0.0093f, 0.5030f, 0.1582f},
    {0.0291f, 0.6082f, 0.1117f}, {0.0633f, 0.7100f, 0.0782f}, {0.1096f, 0.7932f, 0.0573f},
    {0.1655f, 0.8620f, 0.0422f}, {0.2257f, 0.9149f, 0.0298f}, {0.2904f, 0.9540f, 0.0203f},
    {0.3597f, 0.9803f, 0.0134f}, {0.4334f, 0.9950f, 0.0087f}, {0.5121f, 1.0000f, 0.0057f},
    {0.5945f, 0.9950f, 0.0039f}, {0.6784f, 0.9786f, 0.0027f}, {0.7621f, 0.9520f, 0.0021f},
    {0.8425f, 0.9154f, 0.0018f}, {0.9163f, 0.8700f, 0.0017f}, {0.9786f, 0.8163f, 0.0014f},
    {1.0263f, 0.7570f, 0.0011f}, {1.0567f, 0.6949f, 0.0010f}, {1.0622f, 0.6310f, 0.0008f},
    {1.0456f, 0.5668f, 0.0006f}, {1.0026f, 0.5030f, 0.0003f}, {0.9384f, 0.4412f, 0.0002f},
    {0.8544f, 0.3810f, 0.0002f}, {0.7514f, 0.3210f, 0.0001f}, {0.6424f, 0.2650f, 0.0000f},
    {0.5419f, 0.2170f, 0.0000f}, {0.4479f, 0.1750f, 0.0000f}, {0.3608f, 0.1382f, 0.0000f},
    {0.2835f, 0.1070f, 0.0000f}, {0.2187f, 0.0816f, 0.0000f}, {0.1649f, 0.0610f, 0.0000f},
    {0.1212f, 0.0446f, 0.0000f}, {0.0874f, 0.0320f, 0.0000f}, {0.0636f, 0.0232f, 0.0000f},
    {0.0468f, 0.0170f, 0.0000f}, {0.0329f, 0.0119f, 0.0000f}, {0.0227f, 0.0082f, 0.0000f},
    {0.0158f, 0.0057f, 0.0000f}, {0.0114f, 0.0041f, 0.0000f}, {0.0081f, 0.0029f, 0.0000f},
    {0.0058f, 0.0021f, 0.0000f}, {0.0041f, 0.0015f, 0.0000f}, {0.0029f, 0.0010f, 0.0000f},
    {0.0020f, 0.0007f, 0.0000f}, {0.0014f, 0.0005f, 0.0000f}, {0.0010f, 0.0004f, 0.0000f},
    {0.0007f, 0.0002f, 0.0000f}, {0.0005f, 0.0002f, 0.0000f}, {0.0003f, 0.0001f, 0.0000f},
    {0.0002f, 0.0001f, 0.0000f}, {0.0002f, 0.0001f, 0.0000f}, {0.0001f, 0.0000f, 0.0000f},
    {0.0001f, 0.0000f, 0.0000f}, {0.0001f, 0.0000f, 0.0000f}, {0.0000f, 0.0000f, 0.0000f},
}};

}  // namespace

Spectrum raw_blackbody_color(float kelvin) {
  if (!(kelvin >= k_coldest)) return k_coldest_color;
  for (const BlackbodyFit& fit : k_blackbody_fits) {
    if (kelvin >= fit.hottest) continue;
    const auto hyperbola = [kelvin](const std::array<float, 3>& c) {
      return c[0] / kelvin + c[1] * kelvin + c[2];
    };
    const auto& b = fit.blue;
    return {hyperbola(fit.red), hyperbola(fit.green),
            ((b[0] * kelvin + b[1]) * kelvin + b[2]) * kelvin + b[3]};
  }
  return k_hottest_color;
}

Spectrum blackbody_color(float kelvin) {
  return positive(raw_blackbody_color(kelvin));
}

Spectrum wavelength_color(float nm) {
  const float x = (nm - k_first_nm) / k_step_nm;
  if (!(x >= 0.0f && x < static_cast<float>(k_color_matching.size() - 1))) return {};
  const auto i = static_cast<size_t>(x);
  const float t = x - static_cast<float>(i);
  const Vec3 xyz = k_color_matching[i] * (1.0f - t) + k_color_matching[i + 1] * t;
  // The brightest wavelength comes out near 1.
  return positive(xyz_to_rec709(xyz) * (1.0f / 2.52f));
}

}  // namespace tenniel
