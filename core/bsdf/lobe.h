// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "bsdf/ashikhmin_shirley.h"
#include "bsdf/clearcoat.h"
#include "bsdf/diffuse.h"
#include "bsdf/hair.h"
#include "bsdf/hair_fiber.h"
#include "bsdf/microfacet_reflection.h"
#include "bsdf/microfacet_refraction.h"
#include "bsdf/multi_ggx.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/principled_diffuse.h"
#include "bsdf/sheen.h"
#include "bsdf/specular.h"
#include "bsdf/subsurface.h"
#include "bsdf/toon.h"
#include "bsdf/translucent.h"
#include "bsdf/transparent.h"
#include "bsdf/velvet.h"

namespace tenniel {

// Everything that scatters at a surface. Each alternative is trivially copyable and has
//   LobeClass lobe_class()
//   LobeEval eval(wo, wi)         value with |cos wi|, and pdf; zero for a delta
//   optional<LobeSample> sample(wo, u)
//   Spectrum albedo(wo)           cheap estimate; 0 only where the lobe is 0
//   float roughness()             alpha; 1 for diffuse lobes, 0 for perfectly sharp ones
//   bool is_delta()               a rough lobe becomes one where its alpha is tiny (is_specular)
//   bool make_valid()             clamps the parameters to their range; false if not finite
//   void widen(alpha)             roughness at least `alpha`; sharp and diffuse lobes stay
// with directions in the lobe's frame (z = its normal, wo.z > 0; see hair_fiber.h for its own).
using Lobe =
    std::variant<Diffuse, OrenNayar, PrincipledDiffuse, PrincipledSheen, Translucent, Transparent,
                 MicrofacetReflection, MicrofacetRefraction, Clearcoat, SpecularReflection,
                 SpecularRefraction, Velvet, DiffuseToon, GlossyToon, HairLobe, HairFiber,
                 AshikhminShirley, MultiGgxReflection, MultiGgxTransmission, Subsurface>;

static_assert(std::is_trivially_copyable_v<Lobe>);

// Whether `eval` is an estimate and `pdf` is not the exact density of `sample`: see multi_ggx.h.
inline bool is_stochastic(const Lobe& lobe) {
  return std::holds_alternative<MultiGgxReflection>(lobe) ||
         std::holds_alternative<MultiGgxTransmission>(lobe);
}

// `f` of whichever lobe this is. std::visit calls through a table, which the compiler does not see
// through; the chain becomes a jump, and small lobes are inlined.
template <size_t first = 0, class F, class L>
constexpr decltype(auto) visit_lobe(F&& f, L& lobe) {
  if constexpr (first + 1 == std::variant_size_v<Lobe>) {
    return f(*std::get_if<first>(&lobe));
  } else {
    if (lobe.index() == first) return f(*std::get_if<first>(&lobe));
    return visit_lobe<first + 1>(f, lobe);
  }
}

}  // namespace tenniel
