// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/spectrum.h"

namespace tenniel {

// Linear Rec.709 colour of a black body of `kelvin`, of luminance about 1 before what lies out of
// gamut is cut off. The same below 800 and above 12000.
Spectrum blackbody_color(float kelvin);
// The same before it is brought into the gamut: below 1900 K its blue is negative.
Spectrum raw_blackbody_color(float kelvin);

// Linear Rec.709 colour of light of one wavelength in nanometres, by the CIE 1931 observer.
Spectrum wavelength_color(float nanometres);

}  // namespace tenniel
