// SPDX-License-Identifier: Apache-2.0
#include "media/phase_function.h"

#include <algorithm>

#include "math/frame.h"
#include "math/numeric.h"
#include "sampling/warp.h"

namespace tenniel {

namespace {

// Below this the lobe is as good as round, and the inversion of its integral divides by g.
constexpr float k_isotropic = 1e-3f;

}  // namespace

float henyey_greenstein(Vec3 direction, Vec3 wi, float g) {
  if (std::abs(g) < k_isotropic) return uniform_sphere_pdf();
  // (1 - g)^2 + 2 g (1 - cos) by the distance of the two directions: the cosine alone loses the
  // digits that a narrow peak lives on.
  const float peak = sqr(1.0f - std::abs(g));
  const Vec3 off = g > 0.0f ? wi - direction : wi + direction;
  const float d = peak + std::abs(g) * length_squared(off);
  return (1.0f - sqr(g)) * uniform_sphere_pdf() / (d * std::sqrt(d));
}

Vec3 sample_henyey_greenstein(Vec3 direction, float g, Vec2 u) {
  const float a = std::abs(g);
  if (a < k_isotropic) return warp_uniform_sphere(u);
  const float base = 1.0f - a + 2.0f * a * u.x;
  const float s = (1.0f - sqr(a)) / base;
  const float one_minus_cos = (1.0f - a) * (1.0f - u.x) * (s + 1.0f - a) / base;
  const float sine = safe_sqrt(one_minus_cos * (2.0f - one_minus_cos));
  const float phi = k_two_pi * u.y;
  const Frame frame = Frame::from_normal(g > 0.0f ? direction : -direction);
  return frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0f - one_minus_cos});
}

void PhaseFunction::add(Spectrum sigma_s, float g) {
  const float weight = mean(sigma_s);
  if (!(weight > 0.0f)) return;
  g = std::clamp(g, -k_max_anisotropy, k_max_anisotropy);
  const auto end = lobes_.begin() + static_cast<std::ptrdiff_t>(count_);
  auto nearest = std::min_element(lobes_.begin(), end, [g](const Lobe& a, const Lobe& b) {
    return std::abs(a.g - g) < std::abs(b.g - g);
  });
  total_ += weight;
  if (count_ < k_max_lobes && (nearest == end || nearest->g != g)) {
    lobes_[count_++] = {sigma_s, g};
    return;
  }
  const float old = mean(nearest->weight);
  nearest->g = (old * nearest->g + weight * g) / (old + weight);
  nearest->weight += sigma_s;
}

void PhaseFunction::add(const PhaseFunction& other, float scale) {
  if (count_ == 0 && scale == 1.0f) {
    *this = other;
    return;
  }
  for (size_t i = 0; i < other.count_; ++i)
    add(other.lobes_[i].weight * scale, other.lobes_[i].g);
}

PhaseEval PhaseFunction::eval(Vec3 direction, Vec3 wi) const {
  PhaseEval sum;
  for (size_t i = 0; i < count_; ++i) {
    const float p = henyey_greenstein(direction, wi, lobes_[i].g);
    sum.value += lobes_[i].weight * p;
    sum.pdf += mean(lobes_[i].weight) * p;
  }
  if (total_ > 0.0f) sum.pdf /= total_;
  return sum;
}

PhaseSample PhaseFunction::sample(Vec3 direction, float u_lobe, Vec2 u) const {
  float target = u_lobe * total_;
  size_t chosen = 0;
  while (chosen + 1 < count_ && target >= mean(lobes_[chosen].weight))
    target -= mean(lobes_[chosen++].weight);
  const Vec3 wi = sample_henyey_greenstein(direction, lobes_[chosen].g, u);
  return {wi, eval(direction, wi)};
}

}  // namespace tenniel
