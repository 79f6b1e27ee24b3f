// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/sky_analytic.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/hosek_wilkie_data.h"

namespace tenniel {

namespace {

constexpr float k_half_pi = 0.5f * k_pi;
// The analytic skies have a pole at the horizon.
constexpr float k_lowest_theta = k_half_pi - 1e-3f;

// Angle from the zenith and azimuth from +Y.
struct Spherical {
  float theta = 0.0f, phi = 0.0f;
};
Spherical spherical(Vec3 d) {
  return {safe_acos(d.z), std::atan2(d.x, d.y)};
}

float angle_between(Spherical a, Spherical b) {
  return safe_acos(std::sin(a.theta) * std::sin(b.theta) * std::cos(a.phi - b.phi) +
                   std::cos(a.theta) * std::cos(b.theta));
}

// Perez 1993: eq. 3 of Preetham et al.
float perez(const std::array<float, 5>& k, float theta, float gamma) {
  const float cos_gamma = std::cos(gamma);
  return (1.0f + k[0] * std::exp(k[1] / std::cos(theta))) *
         (1.0f + k[2] * std::exp(k[3] * gamma) + k[4] * sqr(cos_gamma));
}

Vec3 from_chromaticity(float x, float y, float luminance_y) {
  if (y == 0.0f) return {0.0f, luminance_y, 0.0f};
  return {x / y * luminance_y, luminance_y, (1.0f - x - y) / y * luminance_y};
}

// Polynomial of the sun's angle, highest power first.
float cubic(float a, float b, float c, float d, float x) {
  return ((a * x + b) * x + c) * x + d;
}

// Bernstein weights of a quintic.
std::array<double, 6> quintic_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s * s * s,        5.0 * s * s * s * s * t, 10.0 * s * s * s * t * t,
          10.0 * s * s * t * t * t, 5.0 * s * t * t * t * t, t * t * t * t * t};
}

}  // namespace

Spectrum visible_color(Vec3 c) {
  return {std::max(3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z, 0.0f),
          std::max(-0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z, 0.0f),
          std::max(0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z, 0.0f)};
}

PreethamSky::PreethamSky(Vec3 to_sun, float t) {
  const Spherical sun = spherical(to_sun);
  const float theta = sun.theta;
  sun_theta_ = theta;
  sun_phi_ = sun.phi;
  // Appendix A.2.
  shape_[0] = {0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
               0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f};
  shape_[1] = {-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f,
               -0.0641f * t - 0.8989f, -0.0033f * t + 0.0452f};
  shape_[2] = {-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f,
               -0.0441f * t - 1.6537f, -0.0109f * t + 0.0529f};
  const float chi = (4.0f / 9.0f - t / 120.0f) * (k_pi - 2.0f * theta);
  // Blender's unit of luminance.
  zenith_[0] = ((4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f) * 0.06f;
  zenith_[1] = cubic(0.00166f, -0.00375f, 0.00209f, 0.0f, theta) * sqr(t) +
               cubic(-0.02903f, 0.06377f, -0.03202f, 0.00394f, theta) * t +
               cubic(0.11693f, -0.21196f, 0.06052f, 0.25886f, theta);
  zenith_[2] = cubic(0.00275f, -0.00610f, 0.00317f, 0.0f, theta) * sqr(t) +
               cubic(-0.04214f, 0.08970f, -0.04153f, 0.00516f, theta) * t +
               cubic(0.15346f, -0.26756f, 0.06670f, 0.26688f, theta);
  for (size_t i = 0; i < 3; ++i)
    zenith_[i] /= perez(shape_[i], 0.0f, theta);
}

Spectrum PreethamSky::radiance(Vec3 direction) const {
  const Spherical d = spherical(direction);
  const float gamma = angle_between(d, {sun_theta_, sun_phi_});
  const float theta = std::min(d.theta, k_lowest_theta);
  float yxy[3];
  for (size_t i = 0; i < 3; ++i)
    yxy[i] = zenith_[i] * perez(shape_[i], theta, gamma);
  return visible_color(from_chromaticity(yxy[1], yxy[2], yxy[0]));
}

HosekWilkieSky::HosekWilkieSky(Vec3 to_sun, float turbidity, float ground_albedo) {
  const Spherical sun = spherical(to_sun);
  sun_theta_ = std::clamp(sun.theta, 0.0f, k_half_pi);
  sun_phi_ = sun.phi;
  const double elevation = static_cast<double>(k_half_pi - sun_theta_) / k_half_pi;
  const auto control = quintic_weights(std::cbrt(std::max(elevation, 0.0)));
  const double t = std::clamp(static_cast<double>(turbidity), 1.0, 10.0);
  const auto low = std::min(static_cast<size_t>(t) - 1, size_t{8});
  const double high_share = t - 1.0 - static_cast<double>(low);
  std::array<std::array<double, 9>, 3> shape{};
  std::array<double, 3> level{};
  // Bilinear over albedo and turbidity, quintic over the elevation (their eqs. 9 to 11).
  for (const size_t albedo : {0u, 1u}) {
    const double albedo_share = albedo == 1 ? ground_albedo : 1.0 - ground_albedo;
    for (const size_t step : {0u, 1u}) {
      const double share = albedo_share * (step == 1 ? high_share : 1.0 - high_share);
      for (size_t c = 0; c < 3; ++c) {
        for (size_t k = 0; k < 6; ++k) {
          const double weight = share * control[k];
          for (size_t i = 0; i < 9; ++i)
            shape[c][i] += weight * k_hosek_wilkie_shape[c][albedo][low + step][k][i];
          level[c] += weight * k_hosek_wilkie_radiance[c][albedo][low + step][k];
        }
      }
    }
  }
  for (size_t c = 0; c < 3; ++c) {
    level_[c] = static_cast<float>(level[c]);
    std::transform(shape[c].begin(), shape[c].end(), shape_[c].begin(),
                   [](double x) { return static_cast<float>(x); });
  }
}

Spectrum HosekWilkieSky::radiance(Vec3 direction) const {
  const Spherical d = spherical(direction);
  const float gamma = angle_between(d, {sun_theta_, sun_phi_});
  const float cos_theta = std::cos(std::min(d.theta, k_lowest_theta));
  const float cos_gamma = std::cos(gamma);
  float xyz[3];
  for (size_t c = 0; c < 3; ++c) {
    const auto& k = shape_[c];
    const float mie =
        (1.0f + sqr(cos_gamma)) / std::pow(1.0f + sqr(k[8]) - 2.0f * k[8] * cos_gamma, 1.5f);
    xyz[c] = level_[c] * (1.0f + k[0] * std::exp(k[1] / (cos_theta + 0.01f))) *
             (k[2] + k[3] * std::exp(k[4] * gamma) + k[5] * sqr(cos_gamma) + k[6] * mie +
              k[7] * std::sqrt(cos_theta));
  }
  // Luminance to Blender's unit.
  return visible_color({xyz[0], xyz[1], xyz[2]}) * (k_two_pi / 683.0f);
}

}  // namespace tenniel
