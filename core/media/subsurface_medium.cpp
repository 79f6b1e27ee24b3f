// SPDX-License-Identifier: Apache-2.0
#include "media/subsurface_medium.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numeric.h"

namespace tenniel {

namespace {

// Least albedo of a walk: the phase functions that guide it have no meaning far below.
constexpr float k_min_albedo = 0.2f;
constexpr float k_max_albedo = 0.999999f;

// Coefficients of ascending powers of g, the published fit.
using Polynomial = std::array<float, 8>;
constexpr Polynomial k_a{1.8260523782f,   -1.28451056436f, -1.79904629312f, 9.19393289202f,
                         -22.8215585862f, 32.0234874259f,  -23.6264803333f, 7.21067002658f};
constexpr Polynomial k_b{
    0.0f,           31.1491581433f,  -201.847017512f, 841.576016723f, -2018.09288505f,
    2731.71560286f, -1935.41424244f, 559.009054474f};
constexpr Polynomial k_c{1.09686102424f, -0.394704063468f, 1.05258115941f, -8.83963712726f,
                         28.8643230661f, -46.8802913581f,  38.5402837518f, -12.7181042538f};
constexpr Polynomial k_d{0.496310210422f, 0.360146581622f, -2.15139309747f, 17.8896899217f,
                         -55.2984010333f, 82.065982243f,   -58.5106008578f, 15.8478295021f};
constexpr Polynomial k_e{
    0.0f,           76.7316253952f,  -594.356773233f, 2448.8834203f, -5576.68528998f,
    7116.60171912f, -4763.54467887f, 1303.5318055f};
constexpr Polynomial k_f{2.40602999408f, -2.51814844609f, 9.18494908356f, -79.2191708682f,
                         259.082868209f, -403.613804597f, 302.85712436f,  -87.4370473567f};

float value(const Polynomial& p, float x) {
  float sum = 0.0f;
  for (size_t i = p.size(); i-- > 0;)
    sum = sum * x + p[i];
  return sum;
}

// Albedo of single scattering for the albedo of a half-space.
float invert(float color, float g) {
  const float b = 4.98511194385f + 0.127355959438f * std::exp(value(k_b, g));
  const float e = 4.23190299701f + 0.00310603949088f * std::exp(value(k_e, g));
  const float low = value(k_a, g) * std::pow(std::atan(b * color), value(k_c, g));
  const float high = value(k_d, g) * std::pow(std::atan(e * color), value(k_f, g));
  return std::clamp(lerp(low, high, std::pow(color, 0.25f)), 0.0f, k_max_albedo);
}

}  // namespace

SubsurfaceMedium::SubsurfaceMedium(Spectrum color, Spectrum mean_free_path, float g)
    : anisotropy(g) {
  const auto extinction = [g](float d) { return 1.0f / (std::max(d, 1e-16f) * (1.0f - g)); };
  sigma_t = {extinction(mean_free_path.r), extinction(mean_free_path.g),
             extinction(mean_free_path.b)};
  const auto fit = [g](float of_surface, float& albedo, float& dimmed) {
    albedo = invert(of_surface, g);
    if (albedo >= k_min_albedo) return;
    dimmed = albedo / k_min_albedo;
    albedo = k_min_albedo;
  };
  fit(color.r, single_albedo.r, scale.r);
  fit(color.g, single_albedo.g, scale.g);
  fit(color.b, single_albedo.b, scale.b);
}

SubsurfaceMedium SubsurfaceMedium::similar() const {
  SubsurfaceMedium result = *this;
  const auto reduce = [g = anisotropy](float& sigma, float& albedo) {
    const float scattering = sigma * albedo * (1.0f - g);
    sigma = sigma * (1.0f - albedo) + scattering;
    albedo = scattering / sigma;
  };
  reduce(result.sigma_t.r, result.single_albedo.r);
  reduce(result.sigma_t.g, result.single_albedo.g);
  reduce(result.sigma_t.b, result.single_albedo.b);
  result.anisotropy = 0.0f;
  return result;
}

}  // namespace tenniel
