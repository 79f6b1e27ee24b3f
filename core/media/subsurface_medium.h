// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/spectrum.h"

namespace tenniel {

// The medium below a surface: a half-space of it, behind a boundary that does not refract, looks
// diffuse in the colour that it was made for. Chiang, Kutz & Burley 2016, "Practical and
// Controllable Subsurface Scattering for Production Path Tracing"; its fit for anisotropic
// scattering is that of Wrenninge, Villemin & Hery 2017, "Path Traced Subsurface Scattering using
// Anisotropic Phase Functions and Non-Exponential Free Flights".
struct SubsurfaceMedium {
  Spectrum sigma_t;         // per metre
  Spectrum single_albedo;   // share of it that scatters
  Spectrum scale{1.0f};     // of what leaves: the darkest colours need walks, too
  float anisotropy = 0.0f;  // mean cosine of Henyey & Greenstein

  // `mean_free_path` in metres after similarity, `anisotropy` within [0, 0.9].
  SubsurfaceMedium(Spectrum color, Spectrum mean_free_path, float anisotropy);

  Spectrum sigma_s() const { return sigma_t * single_albedo; }
  // An isotropic one that looks the same after many scatterings.
  SubsurfaceMedium similar() const;
};

}  // namespace tenniel
