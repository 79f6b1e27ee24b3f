// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "math/spectrum.h"
#include "math/vec.h"
#include "shading/sun_disk.h"

namespace tenniel {

// Radians, metres; densities relative to the Earth's usual.
struct NishitaParameters {
  float sun_elevation = 0.261799f, sun_rotation = 0.0f;
  float sun_size = 0.009512f, sun_intensity = 1.0f;
  float altitude = 0.0f, air_density = 1.0f, dust_density = 1.0f, ozone_density = 1.0f;
  bool sun_disc = true;
  friend bool operator==(const NishitaParameters&, const NishitaParameters&) = default;
};

// Single scattering in the Earth's atmosphere (Nishita et al. 1993, "Display of the Earth Taking
// into Account Atmospheric Scattering") at 21 wavelengths, tabulated over the upper hemisphere with
// the sun at the edge of the table; the sun's disc itself is computed where it is seen.
class NishitaSky {
 public:
  explicit NishitaSky(const NishitaParameters& parameters);
  // Along `direction`, z up, taken for unit length. Below the horizon the sky fades to black.
  Spectrum radiance(Vec3 direction) const;
  std::optional<SunDisk> sun() const;

  // The sky last made is kept, as the same tree is often compiled again.
  static std::shared_ptr<const NishitaSky> make(const NishitaParameters& parameters);

 private:
  Vec3 table_at(float azimuth, float v) const;
  Vec3 sun_xyz(float from_centre, float elevation) const;

  NishitaParameters p_;  // as used: angles wrapped, sizes in range
  Vec3 to_sun_;
  Vec3 sun_bottom_, sun_top_;  // XYZ of the disc's lowest and highest point
  std::vector<Vec3> table_;    // XYZ, bottom row at the horizon
};

}  // namespace tenniel
