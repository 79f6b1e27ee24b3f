// SPDX-License-Identifier: Apache-2.0
#include "bsdf/bsdf.h"

#include <algorithm>

#include "bsdf/shading_normal.h"

namespace tenniel {

namespace {

// Local wo lies at least this far above the lobe's horizon.
constexpr float k_min_cos = 1e-5f;

// A lobe that the estimate calls almost black is still chosen now and then: its value may be large
// in a few directions.
constexpr float k_min_albedo = 1e-3f;

bool differ(Vec3 a, Vec3 b) {
  return !(dot(a, b) > 1.0f - 1e-6f);
}

}  // namespace

void Bsdf::begin(Vec3 geometric_normal, Vec3 shading_normal, Vec3 wo, bool is_hair) {
  is_hair_ = is_hair;
  geometric_normal_ = geometric_normal;
  shading_normal_ = shading_normal;
  wo_ = wo;
  count_ = 0;
  lobes_ = smooth_lobes_ = LobeSet::none();
  is_lambert_ = false;
}

void Bsdf::place(const Spectrum& weight, const Vec3& normal, const Vec3* tangent) {
  Weighted& entry = entries_[static_cast<size_t>(count_)];
  const Vec3 raised =
      is_hair_ || entry.is_fiber ? normal : ensure_valid_reflection(geometric_normal_, wo_, normal);
  const bool has_tangent = tangent && is_finite(*tangent);
  entry.weight = positive(weight);
  entry.frame =
      has_tangent ? Frame::from_normal_tangent(raised, *tangent) : Frame::from_normal(raised);
  entry.wo = entry.frame.to_local(wo_);
  entry.wo.z = std::max(entry.wo.z, k_min_cos);
  entry.is_bumped = entry.scatters_diffusely && differ(raised, shading_normal_);
  if (++count_ > k_max_lobes) drop_faintest();
}

void Bsdf::drop_faintest() {
  const auto end = entries_.begin() + count_;
  const auto faintest = std::min_element(
      entries_.begin(), end,
      [](const Weighted& a, const Weighted& b) { return mean(a.weight) < mean(b.weight); });
  std::move(faintest + 1, end, faintest);
  --count_;
}

void Bsdf::drop_mirrors(bool reflective, bool refractive) {
  const auto is_dropped = [&](const Weighted& entry) {
    if (entry.is_fiber) return false;
    if (entry.lobe_class == LobeClass::glossy) return reflective;
    return entry.lobe_class == LobeClass::transmission && refractive && !entry.scatters_diffusely;
  };
  count_ = static_cast<int>(
      std::remove_if(entries_.begin(), entries_.begin() + count_, is_dropped) - entries_.begin());
}

void Bsdf::finish(float coat_least) {
  has_stochastic_ = false;
  bool has_coat = false;
  is_lambert_ = count_ == 1 && std::holds_alternative<Diffuse>(entries_[0].lobe) && !is_hair_ &&
                !entries_[0].is_bumped;
  if (is_lambert_) {
    entries_[0].probability = 1.0f;
    entries_[0].is_delta = false;
    lobes_ = smooth_lobes_ = LobeSet::of(LobeClass::diffuse);
    return;
  }
  lobes_ = smooth_lobes_ = LobeSet::none();
  float total = 0.0f;
  for (int i = 0; i < count_; ++i) {
    Weighted& entry = entries_[static_cast<size_t>(i)];
    entry.probability = visit_lobe(
        [&entry](const auto& l) {
          entry.is_delta = l.is_delta();
          return mean(entry.weight * l.albedo(entry.wo));
        },
        entry.lobe);
    if (!entry.is_delta)
      entry.probability = std::max(entry.probability, k_min_albedo * mean(entry.weight));
    total += entry.probability;
    lobes_ = lobes_.with(entry.lobe_class);
    if (!entry.is_delta) smooth_lobes_ = smooth_lobes_.with(entry.lobe_class);
    has_stochastic_ |= !entry.is_delta && is_stochastic(entry.lobe);
    has_coat |= !entry.is_delta && std::holds_alternative<Clearcoat>(entry.lobe);
  }
  if (count_ == 1 && total > 0.0f) {
    entries_[0].probability = 1.0f;
    return;
  }
  choose_in_proportion(has_coat ? coat_least * total : 0.0f);
}

void Bsdf::choose_in_proportion(float least) {
  float total = 0.0f;
  for (int i = 0; i < count_; ++i) {
    float& probability = entries_[static_cast<size_t>(i)].probability;
    if (probability > 0.0f) probability = std::max(probability, least);
    total += probability;
  }
  const float scale = total > 0.0f ? 1.0f / total : 0.0f;
  for (int i = 0; i < count_; ++i)
    entries_[static_cast<size_t>(i)].probability *= scale;
}

// Whether light from `wi` is on the side of the true surface that the class scatters to: shading
// normals must not let it leak through.
inline bool Bsdf::reaches(const Weighted& entry, Vec3 wi) const {
  // A flat ribbon stands for something round: on hairs the lobe's own normal says what is inside.
  const float cos_geometric = dot(is_hair_ ? entry.frame.z : geometric_normal_, wi);
  if (entry.lobe_class == LobeClass::transparent || entry.is_round) return true;
  return entry.lobe_class == LobeClass::transmission ? cos_geometric < 0.0f : cos_geometric > 0.0f;
}

// Whether light that was sampled in `wi` counts on a hair whose lobe is that of a face.
bool Bsdf::is_hair_lit_from(const Weighted& entry, Vec3 wi) const {
  const bool is_in_front = dot(shading_normal_, wi) > 0.0f;
  if (entry.lobe_class == LobeClass::transmission) return !is_in_front;
  if (!entry.is_round) return is_in_front;
  // Nor does the reflection of Blender's Hair BSDF go farther around than square to the viewer.
  const Vec3 along = entry.frame.x;
  return is_in_front && dot(wi, wo_ - along * dot(along, wo_)) > 0.0f;
}

inline LobeEval Bsdf::eval_entry(const Weighted& entry, Vec3 wi) const {
  const Vec3 wi_local = entry.frame.to_local(wi);
  LobeEval e = visit_lobe([&](const auto& l) { return l.eval(entry.wo, wi_local); }, entry.lobe);
  e.value *= entry.weight;
  if (entry.is_bumped && entry.is_bump_in_value)
    e.value *= bump_shadowing(shading_normal_, entry.frame.z, wi);
  return e;
}

BsdfEval Bsdf::eval_lobes(Vec3 wi, LobeSet value_lobes, LobeSet pdf_lobes) const {
  BsdfEval sum;
  const LobeSet wanted = (value_lobes | pdf_lobes) & smooth_lobes_;
  if (wanted.empty()) return sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (entry.is_delta || !wanted.has(entry.lobe_class)) continue;
    const bool can_be_drawn = reaches(entry, wi);
    const bool is_lit = is_hair_ && !entry.is_fiber ? is_hair_lit_from(entry, wi) : can_be_drawn;
    if (!can_be_drawn && !is_lit) continue;
    const LobeEval e = eval_entry(entry, wi);
    if (is_lit && value_lobes.has(entry.lobe_class)) sum.value += e.value;
    if (can_be_drawn && pdf_lobes.has(entry.lobe_class)) sum.pdf += entry.probability * e.pdf;
  }
  return sum;
}

Spectrum Bsdf::diffused_beyond_horizon(Vec3 wi, LobeSet lobes) const {
  Spectrum sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (entry.lobe_class == LobeClass::diffuse && !entry.is_delta && lobes.has(entry.lobe_class))
      sum += eval_entry(entry, wi).value;
  }
  return sum;
}

std::optional<BsdfSample> Bsdf::sample_lobes(Vec2 u) const {
  const Weighted* chosen = nullptr;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (!(entry.probability > 0.0f)) continue;
    chosen = &entry;  // the last one also takes what rounding left over
    if (u.x < entry.probability) break;
    u.x -= entry.probability;
  }
  if (!chosen) return std::nullopt;
  u.x = std::min(u.x / chosen->probability, k_one_minus_epsilon);

  BsdfSample s;
  const std::optional<LobeSample> local = visit_lobe(
      [&](const auto& l) {
        s.roughness = l.roughness();
        return l.sample(chosen->wo, u);
      },
      chosen->lobe);
  if (!local) return std::nullopt;
  s.wi = chosen->frame.to_world(local->wi);
  s.lobe_class = chosen->lobe_class;
  s.is_delta = chosen->is_delta;
  s.is_diffuse = chosen->scatters_diffusely;
  if (s.lobe_class == LobeClass::transparent) s.wi = -wo_;
  if (!reaches(*chosen, s.wi)) return std::nullopt;
  s.pdf = chosen->probability * local->pdf;
  if (s.is_delta) {
    s.roughness = 0.0f;
    s.subsurface = std::get_if<Subsurface>(&chosen->lobe);
    s.u_below = u;
  }
  if (s.is_delta || count_ == 1) {
    s.weight = chosen->weight * local->weight * (1.0f / chosen->probability);
    if (chosen->is_bumped) s.weight *= bump_shadowing(shading_normal_, chosen->frame.z, s.wi);
    return s;
  }
  // The mixture of all lobes that reach this direction; the chosen one is not evaluated again.
  Spectrum own = chosen->weight * local->weight;
  if (chosen->is_bumped) own *= bump_shadowing(shading_normal_, chosen->frame.z, s.wi);
  Spectrum value = own * local->pdf;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (&entry == chosen || entry.is_delta || !reaches(entry, s.wi)) continue;
    const LobeEval e = eval_entry(entry, s.wi);
    value += e.value;
    s.pdf += entry.probability * e.pdf;
  }
  s.weight = value / s.pdf;
  // A mixture needs exact densities. Without them each lobe's samples carry that lobe alone.
  if (has_stochastic_) s.weight = own * (1.0f / chosen->probability);
  return s;
}

Spectrum Bsdf::transparency() const {
  Spectrum sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (entry.lobe_class == LobeClass::transparent) sum += entry.weight;
  }
  return sum;
}

Spectrum Bsdf::albedo(LobeSet lobes) const {
  Spectrum sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (lobes.has(entry.lobe_class))
      sum +=
          entry.weight * visit_lobe([&](const auto& l) { return l.albedo(entry.wo); }, entry.lobe);
  }
  return sum;
}

Vec3 Bsdf::average_normal() const {
  Vec3 sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (entry.lobe_class != LobeClass::transparent) sum += entry.frame.z * mean(entry.weight);
  }
  return normalize_or(sum, shading_normal_);
}

Vec3 Bsdf::subsurface_normal() const {
  Vec3 sum;
  for (int i = 0; i < count_; ++i) {
    const Weighted& entry = entries_[static_cast<size_t>(i)];
    if (std::holds_alternative<Subsurface>(entry.lobe)) sum += entry.frame.z * mean(entry.weight);
  }
  return normalize_or(sum, shading_normal_);
}

void Bsdf::widen(float alpha) {
  if (!std::isfinite(alpha)) return;
  for (int i = 0; i < count_; ++i)
    visit_lobe([&](auto& l) { l.widen(std::min(alpha, 1.0f)); },
               entries_[static_cast<size_t>(i)].lobe);
  finish();
}

}  // namespace tenniel
