// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "bsdf/clearcoat.h"
#include "bsdf/diffuse.h"
#include "bsdf/microfacet_reflection.h"
#include "bsdf/microfacet_refraction.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/principled_diffuse.h"
#include "bsdf/sheen.h"
#include "bsdf/specular.h"
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
// with directions in the lobe's frame (z = its normal, wo.z > 0).
using Lobe = std::variant<Diffuse, OrenNayar, PrincipledDiffuse, PrincipledSheen, Translucent,
                          Transparent, MicrofacetReflection, MicrofacetRefraction, Clearcoat,
                          SpecularReflection, SpecularRefraction, Velvet>;

static_assert(std::is_trivially_copyable_v<Lobe>);

}  // namespace tenniel
