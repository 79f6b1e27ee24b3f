// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "math/spectrum.h"
#include "math/vec.h"

// Where a medium scatters to. Both directions are those of travel: g > 0 scatters forward.
namespace tenniel {

// Henyey & Greenstein 1941; `g` is the mean cosine, within +-k_max_anisotropy. Value and density
// per solid angle are one number. Isotropic where g is 0.
constexpr float k_max_anisotropy = 1.0f - 1e-3f;
float henyey_greenstein(Vec3 direction, Vec3 wi, float g);
Vec3 sample_henyey_greenstein(Vec3 direction, float g, Vec2 u);

struct PhaseEval {
  Spectrum value;  // scattering coefficient times phase function: per metre and steradian
  float pdf = 0.0f;
};
struct PhaseSample {
  Vec3 wi;
  PhaseEval eval;
};

// A sum of Henyey-Greenstein lobes, each weighted by its scattering coefficient: what media that
// overlap make together.
class PhaseFunction {
 public:
  static constexpr size_t k_max_lobes = 8;

  PhaseFunction() = default;
  // Copies the lobes that there are: most media have one.
  PhaseFunction(const PhaseFunction& other) : count_(other.count_), total_(other.total_) {
    std::copy_n(other.lobes_.begin(), count_, lobes_.begin());
  }
  PhaseFunction& operator=(const PhaseFunction& other) {
    count_ = other.count_;
    total_ = other.total_;
    std::copy_n(other.lobes_.begin(), count_, lobes_.begin());
    return *this;
  }

  // Lobes of equal `g` become one; what is too many joins the lobe nearest to it.
  void add(Spectrum sigma_s, float g);
  void add(const PhaseFunction& other, float scale = 1.0f);

  PhaseEval eval(Vec3 direction, Vec3 wi) const;
  // Must not be called without a lobe. Lobes are chosen in proportion to their mean weight.
  PhaseSample sample(Vec3 direction, float u_lobe, Vec2 u) const;
  bool empty() const { return count_ == 0; }

 private:
  struct Lobe {
    Spectrum weight;
    float g = 0.0f;
  };
  std::array<Lobe, k_max_lobes> lobes_;
  size_t count_ = 0;
  float total_ = 0.0f;  // sum of the lobes' mean weights
};

}  // namespace tenniel
