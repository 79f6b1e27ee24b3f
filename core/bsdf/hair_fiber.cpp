// SPDX-License-Identifier: Apache-2.0
#include "bsdf/hair_fiber.h"

#include <algorithm>

#include "bsdf/fresnel.h"
#include "math/hash.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr int k_orders = 4;
constexpr float k_half_pi = 0.5f * k_pi;
constexpr float k_inv_two_pi = 0.5f * k_inv_pi;
// Directions closer to the hair's own lie in a cap of no weight.
constexpr float k_min_cos = 1e-5f;

float power(float x, int n) {
  float result = 1.0f;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

// Logarithm of the modified Bessel function of the first kind, order 0 (Abramowitz & Stegun 1964,
// 9.8.1 and 9.8.2: to 2e-7).
float log_bessel_i0(float x) {
  const auto polynomial = [](float t, auto... coefficients) {
    float sum = 0.0f;
    ((sum = sum * t + coefficients), ...);
    return sum;
  };
  if (x < 3.75f)
    return std::log(polynomial(sqr(x / 3.75f), 0.0045813f, 0.0360768f, 0.2659732f, 1.2067492f,
                               3.0899424f, 3.5156229f, 1.0f));
  const float scaled = polynomial(3.75f / x, 0.00392377f, -0.01647633f, 0.02635537f, -0.02057706f,
                                  0.00916281f, -0.00157565f, 0.00225319f, 0.01328592f, 0.39894228f);
  return x + std::log(scaled / std::sqrt(x));
}

// Density over solid angle, without the azimuth, of latitude `theta_i` for light from `theta_o`
// (d'Eon et al. 2011, eq. 7).
float along_hair(float sin_i, float cos_i, float sin_o, float cos_o, float v) {
  const float a = cos_i * cos_o / v, b = sin_i * sin_o / v;
  // Logarithm of 2 v sinh(1 / v), which leaves the range of float where v is small.
  const float total = 1.0f / v + std::log(v * (1.0f - std::exp(-2.0f / v)));
  return std::exp(log_bessel_i0(a) - b - total);
}

// Its sample (d'Eon, Marschner, Hanika 2013): the sine of the latitude.
float sample_along_hair(Vec2 u, float sin_o, float cos_o, float v) {
  const float x = std::max(u.x, 1e-5f);
  const float c = 1.0f + v * std::log(x + (1.0f - x) * std::exp(-2.0f / v));
  const float s = safe_sqrt(1.0f - sqr(c));
  return std::clamp(-c * sin_o + s * std::cos(k_two_pi * u.y) * cos_o, -1.0f, 1.0f);
}

float logistic_cdf(float x, float s) {
  return 1.0f / (1.0f + std::exp(std::min(-x / s, 80.0f)));
}

// The logistic distribution, cut to a full turn.
float around_hair(float phi, float s) {
  const float x = std::exp(-std::abs(phi) / s);
  return x / (s * sqr(1.0f + x) * (1.0f - 2.0f * logistic_cdf(-k_pi, s)));
}

float sample_around_hair(float u, float s) {
  const float low = logistic_cdf(-k_pi, s);
  const float p = std::clamp(u * (1.0f - 2.0f * low) + low, 1e-7f, 1.0f - 6e-8f);
  return std::clamp(-s * std::log(1.0f / p - 1.0f), -k_pi, k_pi);
}

float wrapped(float angle) {
  return angle - k_two_pi * std::floor((angle + k_pi) / k_two_pi);
}

float longitudinal_variance(float roughness) {
  const float r = std::clamp(roughness, 0.001f, 1.0f);
  return sqr(0.726f * r + 0.812f * sqr(r) + 3.7f * power(r, 20));
}

float azimuth(Vec3 w) {
  return std::atan2(-w.y, w.z);
}

float cosine(float sine) {
  return safe_sqrt(1.0f - sqr(sine));
}

// Fit of the paper between the albedo of much hair and the absorption of one.
float absorption_scale(float x) {
  return ((((0.245f * x + 5.574f) * x - 10.73f) * x + 2.532f) * x - 0.215f) * x + 5.969f;
}

}  // namespace

struct HairFiber::Passage {
  float sin_o, cos_o, phi_o;
  float gamma_o, gamma_t;                       // where it enters, and how it is bent
  std::array<Spectrum, k_orders> attenuations;  // of R, TT, TRT, TRRT...
  std::array<float, k_orders> probabilities{};  // of those that this lobe has

  Passage(const HairFiber& fiber, Vec3 wo) : sin_o(wo.x), cos_o(cosine(wo.x)), phi_o(azimuth(wo)) {
    const float h = fiber.offset;
    gamma_o = safe_asin(h);
    const float sin_t = h * cos_o / std::sqrt(sqr(fiber.eta) - sqr(sin_o));
    gamma_t = safe_asin(sin_t);
    const float path = 2.0f * cosine(sin_t) / cosine(sin_o / fiber.eta);
    const auto through = [path](float sigma) { return std::exp(-sigma * path); };
    const Spectrum& sigma = fiber.absorption;
    const Spectrum t{through(sigma.r), through(sigma.g), through(sigma.b)};
    const float f = fresnel_dielectric(cos_o * cosine(h), fiber.eta);
    attenuations[0] = Spectrum(f);
    attenuations[1] = t * sqr(1.0f - f);
    attenuations[2] = attenuations[1] * t * f;
    const auto all_that_follow = [f](float a, float x) {
      return a * safe_divide(x * f, 1.0f - x * f);
    };
    const Spectrum& a = attenuations[2];
    attenuations[3] = {all_that_follow(a.r, t.r), all_that_follow(a.g, t.g),
                       all_that_follow(a.b, t.b)};
    const int first = fiber.is_primary ? 0 : 1, end = fiber.is_primary ? 1 : k_orders;
    float total = 0.0f;
    for (int p = first; p < end; ++p)
      total += probabilities[static_cast<size_t>(p)] = mean(attenuations[static_cast<size_t>(p)]);
    // Where nothing comes through, the direct way stands for all.
    if (!(total > 1e-20f)) probabilities[static_cast<size_t>(first)] = total = 1.0f;
    for (float& p : probabilities)
      p /= total;
  }

  // By how much light of an order turns around the hair.
  float turn(int order) const {
    const auto p = static_cast<float>(order);
    return 2.0f * p * gamma_t - 2.0f * gamma_o + p * k_pi;
  }
};

HairFiber HairFiber::from_roughness(float along, float around, float coat) {
  HairFiber fiber;
  along = std::clamp(along, 0.001f, 1.0f);
  const float s = std::clamp(around, 0.001f, 1.0f);
  fiber.variance = longitudinal_variance(along);
  fiber.primary_variance = longitudinal_variance(along * (1.0f - saturate(coat)));
  fiber.azimuthal_scale =
      (0.265f * s + 1.194f * sqr(s) + 5.372f * power(s, 22)) * std::sqrt(k_pi / 8.0f);
  return fiber;
}

Spectrum HairFiber::absorption_of(Spectrum color, float roughness_around) {
  const float scale = absorption_scale(roughness_around);
  const auto sigma = [scale](float c) { return sqr(std::log(std::max(c, 1e-9f)) / scale); };
  return {sigma(color.r), sigma(color.g), sigma(color.b)};
}

Spectrum HairFiber::absorption_of_melanin(float eumelanin, float pheomelanin) {
  return Spectrum{0.506f, 0.841f, 1.653f} * eumelanin +
         Spectrum{0.343f, 0.733f, 1.924f} * pheomelanin;
}

bool HairFiber::make_valid() {
  const float sum = variance + primary_variance + azimuthal_scale + tilt + eta + offset;
  if (!std::isfinite(sum) || !is_finite(absorption)) return false;
  const auto positive = [](float x) { return std::clamp(x, 0.0f, 1e6f); };
  absorption = {positive(absorption.r), positive(absorption.g), positive(absorption.b)};
  variance = std::clamp(variance, 5e-7f, 100.0f);
  primary_variance = std::clamp(primary_variance, 5e-7f, 100.0f);
  azimuthal_scale = std::clamp(azimuthal_scale, 1e-4f, 100.0f);
  tilt = std::clamp(tilt, -0.2f * k_pi, 0.2f * k_pi);
  eta = std::clamp(eta, 1.001f, 1e3f);
  offset = std::clamp(offset, -1.0f, 1.0f);
  return true;
}

void HairFiber::widen(float alpha) {
  variance = std::max(variance, alpha);
  primary_variance = std::max(primary_variance, alpha);
  azimuthal_scale = std::max(azimuthal_scale, alpha);
}

Spectrum HairFiber::albedo(Vec3 wo) const {
  const Passage passage(*this, wo);
  const auto& a = passage.attenuations;
  return is_primary ? a[0] : a[1] + a[2] + a[3];
}

float HairFiber::order_variance(int order) const {
  return order == 0 ? primary_variance : order == 1 ? 0.25f * variance : 4.0f * variance;
}

float HairFiber::order_tilt(int order) const {
  return order == 0 ? 2.0f * tilt : order == 1 ? -tilt : order == 2 ? -4.0f * tilt : 0.0f;
}

// Light that would leave at a latitude is turned by the tilt; past the pole it comes down again on
// the same side. So up to two latitudes lead to that of `wi`.
float HairFiber::order_pdf(int order, const Passage& passage, Vec3 wi) const {
  // The sine says little near the poles, where the turned density is large.
  const float cos_i = std::max(std::hypot(wi.y, wi.z), k_min_cos);
  const float theta = std::atan2(wi.x, cos_i);
  const float turn = order_tilt(order), v = order_variance(order);
  float along = 0.0f;
  const auto add = [&](float from) {
    if (std::abs(from) > k_half_pi) return;
    const float cos_from = std::cos(from);
    along += along_hair(std::sin(from), cos_from, passage.sin_o, passage.cos_o, v) *
             (turn == 0.0f ? 1.0f : cos_from / cos_i);
  };
  add(theta + turn);
  if (turn != 0.0f) add(std::copysign(k_pi, -turn) - theta + turn);
  if (order == 3) return along * k_inv_two_pi;
  const float phi = azimuth(wi) - passage.phi_o;
  return along * around_hair(wrapped(phi - passage.turn(order)), azimuthal_scale);
}

LobeEval HairFiber::eval(Vec3 wo, Vec3 wi) const {
  const Passage passage(*this, wo);
  LobeEval sum;
  for (int p = 0; p < k_orders; ++p) {
    const auto i = static_cast<size_t>(p);
    if (is_primary != (p == 0)) continue;
    const float density = order_pdf(p, passage, wi);
    sum.value += passage.attenuations[i] * density;
    sum.pdf += passage.probabilities[i] * density;
  }
  return sum;
}

std::optional<LobeSample> HairFiber::sample(Vec3 wo, Vec2 u) const {
  const Passage passage(*this, wo);
  // Three numbers are wanted: the third shows least, and is made of the digits of the others.
  const float inner = uint_to_unit_closed(hash_uint(float_bits(u.x), float_bits(u.y)));
  int order = is_primary ? 0 : 1;
  while (order + 1 < k_orders && u.x >= passage.probabilities[static_cast<size_t>(order)] &&
         !is_primary)
    u.x -= passage.probabilities[static_cast<size_t>(order++)];
  u.x = std::min(safe_divide(u.x, passage.probabilities[static_cast<size_t>(order)]),
                 k_one_minus_epsilon);
  const float sine =
      sample_along_hair({u.x, inner}, passage.sin_o, passage.cos_o, order_variance(order));
  const float theta = safe_asin(sine) - order_tilt(order);
  const float sin_i = std::sin(theta), cos_i = std::abs(std::cos(theta));
  const float turn =
      order == 3 ? k_two_pi * u.y : passage.turn(order) + sample_around_hair(u.y, azimuthal_scale);
  const float phi = passage.phi_o + turn;
  const Vec3 wi = normalize(Vec3{sin_i, -cos_i * std::sin(phi), cos_i * std::cos(phi)});
  const LobeEval e = eval(wo, wi);
  if (!(e.pdf > 0.0f) || !std::isfinite(e.pdf)) return std::nullopt;
  return LobeSample{wi, e.value / e.pdf, e.pdf};
}

}  // namespace tenniel
