// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "math/numeric.h"
#include "math/vec.h"

// The Beckmann microsurface, anisotropic, in a frame with z = the mean normal.
// [Heitz 2014] "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs".
// [Jakob 2014] "An Improved Visible Normal Sampling Routine for the Beckmann Distribution".
namespace tenniel::beckmann {

constexpr float k_inv_sqrt_pi = 0.56418958354775628695f;

// D(m) [Heitz 2014, eq. 80].
inline float normal_density(Vec3 m, float alpha_x, float alpha_y) {
  if (m.z <= 0.0f) return 0.0f;
  const float cos2 = sqr(m.z);
  const float exponent = (sqr(m.x / alpha_x) + sqr(m.y / alpha_y)) / cos2;
  if (!(exponent < 80.0f)) return 0.0f;  // below what a float can hold
  return std::exp(-exponent) / (k_pi * alpha_x * alpha_y * sqr(cos2));
}

namespace detail {
// Inverse error function to single precision (Giles 2010, "Approximating the erfinv function").
inline float erf_inverse(float x) {
  float w = -std::log((1.0f - x) * (1.0f + x));
  float p;
  if (w < 5.0f) {
    w -= 2.5f;
    p = 2.81022636e-08f;
    p = 3.43273939e-07f + p * w;
    p = -3.5233877e-06f + p * w;
    p = -4.39150654e-06f + p * w;
    p = 0.00021858087f + p * w;
    p = -0.00125372503f + p * w;
    p = -0.00417768164f + p * w;
    p = 0.246640727f + p * w;
    p = 1.50140941f + p * w;
  } else {
    w = std::sqrt(w) - 3.0f;
    p = -0.000200214257f;
    p = 0.000100950558f + p * w;
    p = 0.00134934322f + p * w;
    p = -0.00367342844f + p * w;
    p = 0.00573950773f + p * w;
    p = -0.0076224613f + p * w;
    p = 0.00943887047f + p * w;
    p = 1.00167406f + p * w;
    p = 2.83297682f + p * w;
  }
  return p * x;
}

// Slope towards the viewer of the facets visible at angle theta from a surface of alpha = 1:
// inverts the distribution (erf(x) + 1) cos / 2 + exp(-x^2) sin / (2 sqrt(pi)) by Newton steps in b
// = erf(x), where it is nearly linear, kept inside a bracket [Jakob 2014, section 3].
inline float sample_visible_slope(float cos_theta, float sin_theta, float u) {
  const float cot = cos_theta / sin_theta;
  const float edge = std::erf(cot);  // steeper slopes face away
  const auto area_up_to = [&](float b, float x) {
    return 0.5f * (cos_theta * (1.0f + b) + sin_theta * k_inv_sqrt_pi * std::exp(-x * x));
  };
  const float target = u * area_up_to(edge, cot);
  const float theta = std::atan2(sin_theta, cos_theta);
  const float fit = 1.0f + theta * (-0.876f + theta * (0.4265f - 0.0594f * theta));
  float low = -1.0f, high = edge;
  float b = edge - (1.0f + edge) * std::pow(1.0f - u, fit);
  for (int i = 0; i < 10; ++i) {
    if (!(b > low && b < high)) b = 0.5f * (low + high);
    const float x = erf_inverse(b);
    const float excess = area_up_to(b, x) - target;
    if (std::abs(excess) < 1e-6f) break;
    (excess > 0.0f ? high : low) = b;
    b -= excess / (0.5f * (cos_theta - x * sin_theta));
  }
  if (!(b >= low && b <= high)) b = 0.5f * (low + high);
  return erf_inverse(std::clamp(b, -k_one_minus_epsilon, k_one_minus_epsilon));
}
}  // namespace detail

// Area of the microsurface visible from `w`, projected on it: |cos| (1 + Lambda), with the exact
// Lambda [Heitz 2014, eqs. 14, 42, 81], for visible normals are drawn exactly.
inline float visible_area(Vec3 w, float alpha_x, float alpha_y) {
  const float cos_theta = std::abs(w.z);
  const float sine = std::sqrt(sqr(alpha_x * w.x) + sqr(alpha_y * w.y));
  if (cos_theta >= 4.0f * sine) return cos_theta;  // no facet is hidden, to a float
  const float a = cos_theta / sine;
  return 0.5f * (cos_theta * (1.0f + std::erf(a)) + sine * k_inv_sqrt_pi * std::exp(-a * a));
}

// G1 by the rational fit of Walter et al. 2007, section 5.2, up to 0.3 % off; Cycles' pictures show
// the fit.
inline float masking(Vec3 w, float alpha_x, float alpha_y) {
  const float sine = std::sqrt(sqr(alpha_x * w.x) + sqr(alpha_y * w.y));
  const float cos_theta = std::abs(w.z);
  if (cos_theta >= 1.6f * sine) return 1.0f;
  const float a = cos_theta / sine;
  return a * (3.535f + 2.181f * a) / (1.0f + a * (2.276f + 2.577f * a));
}

// Facets as seen from `wo` (wo.z > 0), density D(m) (wo.m) / visible_area(wo).
inline Vec3 sample_visible_normal(Vec3 wo, float alpha_x, float alpha_y, Vec2 u) {
  const Vec3 stretched = normalize({alpha_x * wo.x, alpha_y * wo.y, wo.z});
  const float sin_theta = std::hypot(stretched.x, stretched.y);
  float slope_x, slope_y;
  if (sin_theta < 1e-4f) {
    const float radius = safe_sqrt(-std::log(1.0f - u.x));
    slope_x = radius * std::cos(k_two_pi * u.y);
    slope_y = radius * std::sin(k_two_pi * u.y);
  } else {
    const float towards = detail::sample_visible_slope(stretched.z, sin_theta, u.x);
    const float across = detail::erf_inverse(
        std::clamp(2.0f * u.y - 1.0f, -k_one_minus_epsilon, k_one_minus_epsilon));
    const float cos_phi = stretched.x / sin_theta, sin_phi = stretched.y / sin_theta;
    slope_x = cos_phi * towards - sin_phi * across;
    slope_y = sin_phi * towards + cos_phi * across;
  }
  return normalize({-alpha_x * slope_x, -alpha_y * slope_y, 1.0f});
}

}  // namespace tenniel::beckmann
