// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "bsdf/lobe.h"
#include "math/frame.h"
#include "math/spectrum.h"
#include "math/vec.h"

// Conventions of every scattering function here:
// 1. Directions are unit length and point away from the surface: in world space for `Bsdf`, in the
//    lobe's own frame (z = its shading normal) for a lobe. `wo` goes to where the path came from.
// 2. A value contains |cos(wi, shading normal)|.
// 3. A pdf is per solid angle and, in `Bsdf`, includes the probability of choosing the lobe.
// 4. Delta lobes exist in `sample` only; `eval` gives zero for them.
// 5. Radiance is not scaled by 1/eta^2 at refraction (Cycles' convention).
// 6. `weight` = value / pdf. A sample that cannot be drawn is empty: never NaN, never pdf = 0.
// 7. Samples follow the pdf, but for what is kept of Cycles' look: Clearcoat, and what glossy
//    microfacets send below the horizon of a bent normal.
namespace tenniel {

struct BsdfEval {
  Spectrum value;
  float pdf = 0.0f;
};

struct BsdfSample {
  Vec3 wi;
  Spectrum weight;
  float pdf = 0.0f;  // of a delta lobe: the probability of having chosen it
  LobeClass lobe_class = LobeClass::diffuse;
  bool is_delta = false;
  bool is_diffuse = false;  // reflected or transmitted by a diffuse lobe
  float roughness = 0.0f;   // alpha of the lobe; 1 for diffuse ones
  // Set: the path goes on below the surface, and `wi` is the lobe's normal. Lives in the Bsdf.
  const Subsurface* subsurface = nullptr;
  Vec2 u_below{};  // what the choice of that lobe has left of the numbers
};

// The weighted lobes of one surface point. Lives on the worker's stack; nothing is allocated.
class Bsdf {
 public:
  static constexpr int k_max_lobes = 16;

  // `geometric_normal` and `wo` in world space, both on one side. On a hair the shading normal says
  // which side a sampled light is on, as in Cycles: a flat ribbon stands for something round.
  void begin(Vec3 geometric_normal, Vec3 shading_normal, Vec3 wo, bool is_hair = false);
  // Appends a lobe around `normal` (unit, world; raised where `wo` would lie below it) with
  // anisotropy along `tangent`. Black, non-finite and surplus lobes (beyond k_max_lobes) are
  // dropped, the smallest weight first.
  template <class L>
  void add(const L& lobe, const Spectrum& weight, const Vec3& normal) {
    append(lobe, weight, normal, nullptr);
  }
  template <class L>
  void add(const L& lobe, const Spectrum& weight, const Vec3& normal, const Vec3& tangent) {
    append(lobe, weight, normal, &tangent);
  }
  // Takes away lobes that make caustics: mirror-like reflection, refraction. Before `finish`.
  void drop_caustics(bool reflective, bool refractive) {
    if (reflective || refractive) drop_mirrors(reflective, refractive);
  }
  // After the last `add`: fixes the probability of each lobe (proportional to weight * albedo(wo)).
  // Beside a coat, whose samples do not follow its density, that shows: then no lobe counts as less
  // than `coat_least` of the sum of all.
  void finish(float coat_least = 0.0f);

  // Value over `value_lobes`, pdf over `pdf_lobes`: a light hidden from some lobes drops their
  // value but not their pdf, and a looking glass asks for one group in both.
  BsdfEval eval(Vec3 wi, LobeSet value_lobes = LobeSet::all(),
                LobeSet pdf_lobes = LobeSet::all()) const {
    return is_lambert_ ? eval_lambert(wi, value_lobes, pdf_lobes)
                       : eval_lobes(wi, value_lobes, pdf_lobes);
  }
  // What `eval` leaves out: diffuse reflection toward a `wi` above the shading normal's horizon but
  // below the true one, which no sample takes. For light on the smooth surface that facets stand
  // for. Not of glossy lobes: light samples alone would meet their peaks once in a million.
  Spectrum value_beyond_horizon(Vec3 wi, LobeSet lobes) const {
    // On a hair `eval` leaves out nothing.
    if (is_hair_ || dot(geometric_normal_, wi) > 0.0f || !(dot(shading_normal_, wi) > 0.0f))
      return {};
    return diffused_beyond_horizon(wi, lobes);
  }
  // The first number chooses the lobe too: what is left of it is as even as the pair was, lobe by
  // lobe, where a third number would spread the directions of each at random.
  std::optional<BsdfSample> sample(Vec2 u) const {
    return is_lambert_ ? sample_lambert(u) : sample_lobes(u);
  }

  // Sum of the weights that pass straight through (transparent lobes).
  Spectrum transparency() const;
  // Which classes are present, and which of them have a lobe that is not a delta.
  LobeSet lobes() const { return lobes_; }
  LobeSet smooth_lobes() const { return smooth_lobes_; }
  bool empty() const { return count_ == 0; }
  // Whether every sample is the same: none, or that of a mirror or of a hole.
  bool is_certain() const {
    if (count_ != 1) return empty();
    const bool has_one_way = lobes_.has(LobeClass::glossy) || lobes_.has(LobeClass::transparent);
    return has_one_way && smooth_lobes_.empty();
  }
  // weight * albedo(wo) summed over the lobes of a set.
  Spectrum albedo(LobeSet lobes = LobeSet::all()) const;
  // Mean of the lobes' normals by weight, unit, world space: the Normal pass.
  Vec3 average_normal() const;
  // The same of the lobes that go below the surface.
  Vec3 subsurface_normal() const;
  // Widens glossy lobes to at least `alpha` (filter glossy after a rough bounce); perfectly sharp
  // lobes stay. Before or after `finish`.
  void widen(float alpha);

 private:
  struct Weighted {
    Lobe lobe;
    Spectrum weight;
    Frame frame;
    Vec3 wo;  // in `frame`
    float probability = 0.0f;
    LobeClass lobe_class = LobeClass::diffuse;
    bool is_delta = false;
    bool is_round = false;            // scatters all around a hair: its directions have no sides
    bool is_fiber = false;            // so do its values
    bool scatters_diffusely = false;  // diffuse or translucent
    bool is_bumped = false;           // so, and around another normal than the shading one
    bool is_bump_in_value = true;     // which shades `eval` too
  };
  // `lobe`: one of the alternatives, or a Lobe that holds any.
  template <class L>
  void append(const L& lobe, const Spectrum& weight, const Vec3& normal, const Vec3* tangent);
  // Keeps the entry behind the last, whose lobe is set and valid.
  void place(const Spectrum& weight, const Vec3& normal, const Vec3* tangent);
  void drop_faintest();
  void choose_in_proportion(float least);
  BsdfEval eval_lobes(Vec3 wi, LobeSet value_lobes, LobeSet pdf_lobes) const;
  std::optional<BsdfSample> sample_lobes(Vec2 u) const;
  BsdfEval eval_lambert(Vec3 wi, LobeSet value_lobes, LobeSet pdf_lobes) const;
  std::optional<BsdfSample> sample_lambert(Vec2 u) const;
  void drop_mirrors(bool reflective, bool refractive);
  Spectrum diffused_beyond_horizon(Vec3 wi, LobeSet lobes) const;
  // One entry's part of `eval`: its value times weight, its pdf without the probability.
  LobeEval eval_entry(const Weighted& entry, Vec3 wi) const;
  bool reaches(const Weighted& entry, Vec3 wi) const;
  bool is_hair_lit_from(const Weighted& entry, Vec3 wi) const;

  std::array<Weighted, k_max_lobes + 1> entries_;
  int count_ = 0;
  LobeSet lobes_ = LobeSet::none(), smooth_lobes_ = LobeSet::none();
  bool has_stochastic_ = false, is_hair_ = false;
  // One Lambert lobe around the shading normal of a face is all: the commonest surface by far, and
  // worth a way of its own.
  bool is_lambert_ = false;
  Vec3 geometric_normal_, shading_normal_, wo_;
};

inline BsdfEval Bsdf::eval_lambert(Vec3 wi, LobeSet value_lobes, LobeSet pdf_lobes) const {
  const Weighted& entry = entries_[0];
  BsdfEval e;
  if (!(dot(geometric_normal_, wi) > 0.0f)) return e;
  const float pdf = cosine_hemisphere_pdf(dot(entry.frame.z, wi));
  if (value_lobes.has(LobeClass::diffuse)) e.value = entry.weight * pdf;
  if (pdf_lobes.has(LobeClass::diffuse)) e.pdf = pdf;
  return e;
}

inline std::optional<BsdfSample> Bsdf::sample_lambert(Vec2 u) const {
  const Weighted& entry = entries_[0];
  const Vec3 local = warp_cosine_hemisphere(u);
  const Vec3 wi = entry.frame.to_world(local);
  const float pdf = cosine_hemisphere_pdf(local.z);
  if (!(pdf > 0.0f) || !(dot(geometric_normal_, wi) > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi,
                    .weight = entry.weight,
                    .pdf = pdf,
                    .lobe_class = LobeClass::diffuse,
                    .is_diffuse = true,
                    .roughness = Diffuse::roughness()};
}

// Made where it stays: a copy of the whole variant would wait for each of its parts to be written.
template <class L>
void Bsdf::append(const L& lobe, const Spectrum& weight, const Vec3& normal, const Vec3* tangent) {
  if constexpr (std::is_same_v<L, Lobe>) {
    visit_lobe([&](const auto& l) { append(l, weight, normal, tangent); }, lobe);
  } else {
    if (!(max_component(weight) > 0.0f) || !is_finite(weight) || !is_finite(normal)) return;
    // There is room for one more than is kept.
    Weighted& entry = entries_[static_cast<size_t>(count_)];
    L& kept = entry.lobe.template emplace<L>(lobe);
    if (!kept.make_valid()) return;
    entry.lobe_class = kept.lobe_class();
    entry.is_fiber = std::is_same_v<L, HairFiber>;
    entry.is_round = entry.is_fiber || (is_hair_ && std::is_same_v<L, HairLobe>);
    entry.scatters_diffusely =
        entry.lobe_class == LobeClass::diffuse || std::is_same_v<L, Translucent>;
    // In Cycles a bump shades samples of Velvet as diffuse, but not its values: by number it is one
    // of the glossy closures.
    entry.is_bump_in_value = !std::is_same_v<L, Velvet>;
    place(weight, normal, tangent);
  }
}

}  // namespace tenniel
