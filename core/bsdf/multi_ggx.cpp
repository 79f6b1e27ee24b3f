// SPDX-License-Identifier: Apache-2.0
#include "bsdf/multi_ggx.h"

#include <algorithm>
#include <cmath>

#include "math/hash.h"
#include "sampling/sampler.h"

namespace tenniel {

namespace {

constexpr int k_max_orders = 10;
// Beyond, a direction is the normal and sees the surface as flat.
constexpr float k_upright = 0.9999f;

// Smith's Lambda, continued below the horizon: -1 - Lambda of the opposite direction.
float smith_lambda(const MultiScatter& s, Vec3 w) {
  if (w.z > k_upright) return 0.0f;
  if (w.z < -k_upright) return -1.0f;
  const float stretched2 = sqr(s.alpha_x * w.x) + sqr(s.alpha_y * w.y);
  const float root = std::sqrt(1.0f + stretched2 / std::max(sqr(w.z), 1e-7f));
  return 0.5f * (std::copysign(root, w.z) - 1.0f);
}

// Area of facets that light travelling along `w` meets.
float met_area(const MultiScatter& s, Vec3 w) {
  const float stretched2 = sqr(s.alpha_x * w.x) + sqr(s.alpha_y * w.y) + sqr(w.z);
  return std::max(0.5f * (std::sqrt(stretched2) - w.z), 1e-7f);
}

float density(const MultiScatter& s, Vec3 m) {
  return ggx::normal_density(m, s.alpha_x, s.alpha_y);
}

// What a walk over glass is for: light that ends on either side, or on one alone. Walks that end on
// the other side are thrown away, so the first facet is made to lead where they are wanted.
enum class Sought : uint8_t { either, reflected, passed };

// Probability that the first facet reflects. The event that is not sought keeps half of its true
// chance, so that no walk weighs more than twice.
float reflection_chance(float reflectance, Sought sought) {
  if (sought == Sought::either || !(reflectance < 1.0f)) return reflectance;
  return sought == Sought::reflected ? 0.5f + 0.5f * reflectance : 0.5f * reflectance;
}

// What a facet makes of light along `w` into `out`, per solid angle, and the tint of it.
Spectrum phase(const MultiScatter& s, Vec3 w, Vec3 out, float eta, Sought sought = Sought::either) {
  if (out.z > 0.0f) {
    const Vec3 m = normalize_or(out - w, {0.0f, 0.0f, -1.0f});
    const float cosine = dot(-w, m);
    if (!(m.z > 0.0f) || !(cosine > 0.0f)) return {};
    const float reflectance =
        eta > 0.0f ? reflection_chance(fresnel_dielectric(cosine, eta), sought) : 1.0f;
    return s.reflecting(cosine) * (reflectance * density(s, m) / (4.0f * met_area(s, w)));
  }
  if (!(eta > 0.0f)) return {};
  Vec3 half = out * eta - w;
  if (half.z < 0.0f) half = -half;
  const Vec3 m = normalize_or(half, {0.0f, 0.0f, -1.0f});
  const float cos_in = dot(-w, m), cos_out = dot(out, m);
  if (!(m.z > 0.0f) || !(cos_in > 0.0f) || !(cos_out < 0.0f)) return {};
  const float jacobian = sqr(eta) * -cos_out / std::max(sqr(cos_in + eta * cos_out), 1e-12f);
  const float transmittance = 1.0f - reflection_chance(fresnel_dielectric(cos_in, eta), sought);
  return s.passing * (transmittance * cos_in * density(s, m) * jacobian / met_area(s, w));
}

// Light on its way over the heights of the surface. Heights are uniform; `depth` is the share of
// them below the light. Inside the material everything is mirrored at the mean plane.
class Walk {
 public:
  Walk(const MultiScatter& surface, Vec3 wo, uint32_t seed, Sought sought = Sought::either)
      : s_(surface), random_(seed), w_(-wo), eta_(surface.eta), sought_(sought) {}

  // False when the light has left.
  bool meets_surface() {
    const float u = random_.get_1d();
    if (w_.z > k_upright) return false;
    const float lambda = smith_lambda(s_, w_);
    if (w_.z < -k_upright) {
      depth_ *= u;
    } else if (std::abs(w_.z) >= 1e-4f) {
      const float escape = w_.z > 0.0f ? std::pow(depth_, lambda) : 0.0f;
      if (u > 1.0f - escape) return false;
      if (lambda != 0.0f) depth_ *= std::pow(1.0f - u, -1.0f / lambda);
    }
    return true;
  }

  void scatter() {
    const Vec3 m = ggx::sample_visible_normal(-w_, s_.alpha_x, s_.alpha_y, random_.get_2d());
    const float cosine = dot(-w_, m);
    const float u = random_.get_1d();
    if (order_++ > 0) throughput_ *= s_.tint;
    const bool reflects = !(eta_ > 0.0f) || is_reflected(fresnel_dielectric(cosine, eta_), u);
    const auto refracted = reflects ? std::nullopt : refract(-w_, m, eta_);
    if (!refracted) {
      throughput_ *= s_.reflecting(cosine);
      w_ = normalize(reflect(-w_, m));
      return;
    }
    throughput_ *= s_.passing;
    w_ = -*refracted;
    depth_ = 1.0f - depth_;
    eta_ = 1.0f / eta_;
    is_outside_ = !is_outside_;
  }

  // Toward `wi` from the facet that was met, and out of the surface.
  Spectrum connected(Vec3 wi) const {
    const Vec3 local = is_outside_ ? wi : -wi;
    const float above = local.z > 0.0f ? depth_ : 1.0f - depth_;
    const Vec3 leaving = wi.z > 0.0f ? wi : -wi;
    const float unmasked = std::pow(above, smith_lambda(s_, leaving));
    const Spectrum tint = order_ > 0 ? s_.tint : Spectrum(1.0f);
    return throughput_ * tint * phase(s_, w_, local, eta_) * unmasked;
  }

  Vec3 direction() const { return is_outside_ ? w_ : -w_; }
  Spectrum throughput() const { return throughput_; }

 private:
  // Chooses, and pays for a chance that is not the true one.
  bool is_reflected(float reflectance, float u) {
    const Sought sought = order_ == 1 ? sought_ : Sought::either;
    const float chance = reflection_chance(reflectance, sought);
    const bool reflects = u < chance;
    if (sought != Sought::either)
      throughput_ *= reflects ? reflectance / chance : (1.0f - reflectance) / (1.0f - chance);
    return reflects;
  }

  const MultiScatter& s_;
  LocalRandom random_;
  Vec3 w_;
  float eta_, depth_ = 1.0f;
  Sought sought_;
  Spectrum throughput_{1.0f};
  int order_ = 0;
  bool is_outside_ = true;
};

uint32_t seed_of(const MultiScatter& s, Vec3 a, Vec3 b) {
  const uint32_t first = hash_uint(float_bits(a.x), float_bits(a.y), float_bits(b.x));
  return hash_uint(s.seed, first, float_bits(b.y), float_bits(b.z));
}

// The first bounce in closed form, the others by one walk. The first facet's height follows from
// both directions: G2 of reflection, a beta function of refraction (Heitz et al., eqs. 17, 20).
Spectrum estimate(const MultiScatter& s, Vec3 wo, Vec3 wi) {
  const float below = 1.0f + smith_lambda(s, wo);
  const float above = smith_lambda(s, wi.z > 0.0f ? wi : -wi);
  const float both_seen =
      wi.z > 0.0f ? below / (below + above) : below * std::beta(below, 1.0f + above);
  Spectrum value = phase(s, -wo, wi, s.eta) * both_seen;
  Walk walk(s, wo, seed_of(s, wo, wi));
  for (int order = 0; order < k_max_orders && walk.meets_surface(); ++order) {
    if (order > 0) value += walk.connected(wi);
    walk.scatter();
  }
  return is_finite(value) ? value : Spectrum();
}

// Share of the light that bounces once only, about.
float single_share(const MultiScatter& s) {
  return 1.0f / (1.0f + 0.9f * s.alpha_x * s.alpha_y);
}

Sought sought_in(Vec3 wi) {
  return wi.z > 0.0f ? Sought::reflected : Sought::passed;
}

// One bounce where there is but one, the cosine for the rest.
float approximate_pdf(const MultiScatter& s, Vec3 wo, Vec3 wi) {
  MultiScatter plain = s;
  plain.reflecting = Fresnel::none();
  plain.passing = Spectrum(1.0f);
  const Sought sought = sought_in(wi);
  const float once = phase(plain, -wo, wi, s.eta, sought).r;
  float share = 1.0f;
  if (s.eta > 0.0f) {
    const float reflects = reflection_chance(fresnel_dielectric(wo.z, s.eta), sought);
    share = wi.z > 0.0f ? reflects : 1.0f - reflects;
  }
  const float single = single_share(s);
  return single * once + (1.0f - single) * (share + 0.01f) * std::abs(wi.z) * k_inv_pi;
}

std::optional<LobeSample> sample_walk(const MultiScatter& s, Vec3 wo, Vec2 u, bool passes) {
  if (!(wo.z > 0.0f)) return std::nullopt;
  Walk walk(s, wo, hash_uint(s.seed, float_bits(u.x), float_bits(u.y)),
            passes ? Sought::passed : Sought::reflected);
  for (int order = 0; order <= k_max_orders; ++order) {
    if (!walk.meets_surface()) {
      const Vec3 wi = walk.direction();
      if (passes ? !(wi.z < 0.0f) : !(wi.z > 0.0f)) return std::nullopt;
      const float pdf = approximate_pdf(s, wo, wi);
      if (!(pdf > 0.0f) || !std::isfinite(pdf)) return std::nullopt;
      return LobeSample{wi, walk.throughput(), pdf};
    }
    walk.scatter();
  }
  return std::nullopt;
}

float macro_reflectance(const MultiScatter& s, Vec3 wo) {
  return s.eta > 0.0f ? fresnel_dielectric(wo.z, s.eta) : 1.0f;
}

// The same over facets that lean either way: where a smooth surface reflects all a rough one lets
// much through.
float mean_reflectance(const MultiScatter& s, Vec3 wo) {
  if (!(s.eta > 0.0f)) return 1.0f;
  const float tilt = std::min(std::sqrt(s.alpha_x * s.alpha_y), 1.0f);
  const float scale = 1.0f / std::sqrt(1.0f + sqr(tilt));
  const float level = wo.z * scale,
              lean = tilt * std::sqrt(std::max(1.0f - sqr(wo.z), 0.0f)) * scale;
  const auto of = [&s](float cosine) {
    return fresnel_dielectric(std::clamp(cosine, 0.0f, 1.0f), s.eta);
  };
  return (of(wo.z) + of(level + lean) + of(level - lean)) * (1.0f / 3.0f);
}

}  // namespace

bool MultiScatter::make_valid() {
  if (!std::isfinite(alpha_x) || !std::isfinite(alpha_y) || !std::isfinite(eta)) return false;
  if (!is_finite(tint) || !is_finite(passing) || !reflecting.is_finite()) return false;
  alpha_x = std::clamp(alpha_x, 1e-4f, 1.0f);
  alpha_y = std::clamp(alpha_y, 1e-4f, 1.0f);
  if (eta != 0.0f) eta = std::clamp(eta, 1e-3f, 1e3f);
  for (Spectrum* color : {&tint, &passing})
    *color = {saturate(color->r), saturate(color->g), saturate(color->b)};
  return true;
}

void MultiGgxReflection::widen(float alpha) {
  surface.alpha_x = std::max(surface.alpha_x, alpha);
  surface.alpha_y = std::max(surface.alpha_y, alpha);
}
void MultiGgxTransmission::widen(float alpha) {
  surface.alpha_x = std::max(surface.alpha_x, alpha);
  surface.alpha_y = std::max(surface.alpha_y, alpha);
}

Spectrum MultiGgxReflection::albedo(Vec3 wo) const {
  return surface.reflecting(wo.z) * mean_reflectance(surface, wo);
}
Spectrum MultiGgxTransmission::albedo(Vec3 wo) const {
  return surface.passing * std::max(1.0f - mean_reflectance(surface, wo), 0.05f);
}

LobeEval MultiGgxReflection::eval(Vec3 wo, Vec3 wi) const {
  if (is_delta() || !(wo.z > 1e-5f) || !(wi.z > 1e-5f)) return {};
  const float pdf = approximate_pdf(surface, wo, wi);
  if (!(pdf > 0.0f) || !std::isfinite(pdf)) return {};
  // The lower direction's walk is the shorter; reflection is reciprocal.
  if (wi.z < wo.z) return {estimate(surface, wi, wo) * (wi.z / wo.z), pdf};
  return {estimate(surface, wo, wi), pdf};
}

LobeEval MultiGgxTransmission::eval(Vec3 wo, Vec3 wi) const {
  if (is_delta() || !(wo.z > 1e-5f) || !(wi.z < -1e-5f)) return {};
  const float pdf = approximate_pdf(surface, wo, wi);
  if (!(pdf > 0.0f) || !std::isfinite(pdf)) return {};
  return {estimate(surface, wo, wi), pdf};
}

std::optional<LobeSample> MultiGgxReflection::sample(Vec3 wo, Vec2 u) const {
  if (!is_delta()) return sample_walk(surface, wo, u, false);
  const auto mirrored = SpecularReflection{surface.reflecting}.sample(wo, u);
  if (!mirrored) return mirrored;
  return LobeSample{mirrored->wi, mirrored->weight * macro_reflectance(surface, wo)};
}

std::optional<LobeSample> MultiGgxTransmission::sample(Vec3 wo, Vec2 u) const {
  if (!is_delta()) return sample_walk(surface, wo, u, true);
  const auto refracted = SpecularRefraction{surface.eta}.sample(wo, u);
  if (!refracted) return refracted;
  const Spectrum weight = surface.passing * (1.0f - macro_reflectance(surface, wo));
  return LobeSample{refracted->wi, refracted->weight * weight};
}

}  // namespace tenniel
