// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/sky_nishita.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "math/numeric.h"
#include "shading/nodes/sky_analytic.h"

namespace tenniel {

namespace {

constexpr float k_half_pi = 0.5f * k_pi;
constexpr size_t k_width = 512, k_height = 128;

// The atmosphere, in metres.
constexpr float k_earth_radius = 6360e3f, k_atmosphere_radius = 6420e3f;
constexpr float k_air_height = 8e3f, k_dust_height = 1.2e3f;  // where a density falls to 1 / e
constexpr float k_dust_scattering = 2e-5f, k_dust_extinction = 1.11f * k_dust_scattering;
constexpr float k_dust_anisotropy = 0.76f;
constexpr size_t k_steps = 32;

constexpr size_t k_wavelengths = 21;
constexpr float k_first_wavelength = 380.0f, k_wavelength_step = 20.0f;  // nm
using SpectralArray = std::array<float, k_wavelengths>;

// Absorption by ozone where it is densest, per metre.
constexpr SpectralArray k_ozone_absorption = {
    3.25126850e-9f, 5.85395365e-9f, 1.97719116e-8f, 7.30956876e-8f, 2.00845615e-7f, 4.03839581e-7f,
    6.35513359e-7f, 9.67070412e-7f, 1.54797400e-6f, 2.09038647e-6f, 2.46128056e-6f, 2.73551299e-6f,
    2.15125863e-6f, 1.59051841e-6f, 1.12356198e-6f, 7.35275515e-7f, 4.64501304e-7f, 3.30960799e-7f,
    2.25126123e-7f, 1.48791293e-7f, 1.68286234e-7f};

// CIE 1931 colour matching functions of the 2 degree observer.
constexpr Vec3 k_color_matching[k_wavelengths] = {{0.001368f, 0.000039f, 0.006450001f},
                                                  {0.01431f, 0.000396f, 0.06785001f},
                                                  {0.13438f, 0.0040f, 0.6456f},
                                                  {0.34828f, 0.0230f, 1.74706f},
                                                  {0.29080f, 0.0600f, 1.6692f},
                                                  {0.09564f, 0.13902f, 0.8129501f},
                                                  {0.00490f, 0.3230f, 0.2720f},
                                                  {0.06327f, 0.7100f, 0.07824999f},
                                                  {0.29040f, 0.9540f, 0.0203f},
                                                  {0.59450f, 0.9950f, 0.0039f},
                                                  {0.91630f, 0.8700f, 0.001650001f},
                                                  {1.06220f, 0.6310f, 0.0008f},
                                                  {0.8544499f, 0.3810f, 0.00019f},
                                                  {0.44790f, 0.1750f, 0.00002f},
                                                  {0.16490f, 0.0610f, 0.0f},
                                                  {0.04677f, 0.0170f, 0.0f},
                                                  {0.01135916f, 0.004102f, 0.0f},
                                                  {0.002899327f, 0.001047f, 0.0f},
                                                  {0.0006900786f, 0.0002492f, 0.0f},
                                                  {0.0001661505f, 0.00006f, 0.0f},
                                                  {0.00004150994f, 0.00001499f, 0.0f}};

float wavelength(size_t i) {
  return k_first_wavelength + k_wavelength_step * static_cast<float>(i);
}

// Irradiance above the atmosphere, W / (m^2 nm): a black body of 5778 K as large as the sun.
float solar_irradiance(float nm) {
  constexpr double k_radiation = 1.191042972e20, k_hc_over_k = 1.438776877e7;  // nm, K
  constexpr double k_solid_angle = 6.7901634e-5, k_temperature = 5778.0;
  const double l = nm;
  return static_cast<float>(k_solid_angle * k_radiation / (l * l * l * l * l) /
                            std::expm1(k_hc_over_k / (l * k_temperature)));
}

// Scattering by air at sea level, per metre: Rayleigh's fourth power.
float air_scattering(float nm) {
  return 1.1311487658e6f / (sqr(nm) * sqr(nm));
}

struct Spectra {
  SpectralArray sun, air;
  Spectra() {
    for (size_t i = 0; i < k_wavelengths; ++i) {
      sun[i] = solar_irradiance(wavelength(i));
      air[i] = air_scattering(wavelength(i));
    }
  }
};
const Spectra& spectra() {
  static const Spectra s;
  return s;
}

Vec3 to_xyz(const SpectralArray& spectrum) {
  Vec3 xyz;
  for (size_t i = 0; i < k_wavelengths; ++i)
    xyz += k_color_matching[i] * spectrum[i];
  return xyz * k_wavelength_step;
}

// x: air, y: dust, z: ozone (a tent between 10 and 40 km).
Vec3 density_at(float height) {
  const float ozone = std::max(0.0f, 1.0f - std::abs(height - 25e3f) / 15e3f);
  return {std::exp(-height / k_air_height), std::exp(-height / k_dust_height), ozone};
}

float extinction(Vec3 optical_depth, size_t i) {
  return optical_depth.x * spectra().air[i] + optical_depth.y * k_dust_extinction +
         optical_depth.z * k_ozone_absorption[i];
}

// Distance along a ray to a sphere around the Earth's centre, from inside of it.
float distance_to_sphere(Vec3 from, Vec3 direction, float radius) {
  const float b = dot(direction, from);
  return -b + std::sqrt(std::max(b * b - (length_squared(from) - sqr(radius)), 0.0f));
}

bool is_shadowed_by_earth(Vec3 from, Vec3 to_sun) {
  if (to_sun.z >= 0.0f) return false;
  const float b = dot(to_sun, from);
  return b * b - (length_squared(from) - sqr(k_earth_radius)) >= 0.0f;
}

// Densities integrated up to the end of the atmosphere. They fall exponentially, so Gauss-Laguerre
// quadrature of order 8 serves, its nodes scaled to end inside the atmosphere (x / 25) and its
// weights freed of the exponential (w e^x / 25).
Vec3 optical_depth_along(Vec3 from, Vec3 direction) {
  constexpr float k_nodes[] = {0.006811185292f, 0.03614807107f, 0.09004346519f, 0.1706680068f,
                               0.2818362161f,   0.4303406404f,  0.6296271457f,  0.9145252695f};
  constexpr float k_weights[] = {0.01750893642f, 0.04135477391f, 0.06678839063f, 0.09507698807f,
                                 0.1283416365f,  0.1707430204f,  0.2327233347f,  0.3562490486f};
  const float length_in_air = distance_to_sphere(from, direction, k_atmosphere_radius);
  Vec3 sum;
  for (size_t i = 0; i < 8; ++i) {
    const Vec3 p = from + direction * (length_in_air * k_nodes[i]);
    sum += density_at(length(p) - k_earth_radius) * k_weights[i];
  }
  return sum * length_in_air;
}

float air_phase(float mu) {
  return 3.0f / (16.0f * k_pi) * (1.0f + sqr(mu));
}

// Cornette and Shanks 1992.
float dust_phase(float mu) {
  constexpr float g = k_dust_anisotropy, g2 = g * g;
  return 3.0f * (1.0f - g2) * (1.0f + sqr(mu)) /
         (8.0f * k_pi * (2.0f + g2) * std::pow(1.0f + g2 - 2.0f * g * mu, 1.5f));
}

// Sunlight scattered once toward `eye` along `direction`.
SpectralArray scattered_light(Vec3 eye, Vec3 direction, Vec3 to_sun, Vec3 density_scale) {
  const float mu = dot(direction, to_sun);
  const float air = air_phase(mu), dust = dust_phase(mu) * k_dust_scattering;
  const float step =
      distance_to_sphere(eye, direction, k_atmosphere_radius) / static_cast<float>(k_steps);
  SpectralArray sum{};
  Vec3 depth;
  for (size_t s = 0; s < k_steps; ++s) {
    const Vec3 p = eye + direction * (step * (static_cast<float>(s) + 0.5f));
    const Vec3 density = density_scale * density_at(length(p) - k_earth_radius);
    depth += density * step;
    if (is_shadowed_by_earth(p, to_sun)) continue;
    const Vec3 total = depth + density_scale * optical_depth_along(p, to_sun);
    for (size_t i = 0; i < k_wavelengths; ++i)
      sum[i] += std::exp(-extinction(total, i)) *
                (air * density.x * spectra().air[i] + dust * density.y) * spectra().sun[i] * step;
  }
  return sum;
}

Vec3 from_elevation(float elevation, float azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// Mean radiance of the sun's disc at an elevation, XYZ. Ozone does not dim it.
Vec3 disc_at(Vec3 eye, float elevation, const NishitaParameters& p) {
  const float solid_angle = k_two_pi * (1.0f - std::cos(0.5f * p.sun_size));
  const Vec3 depth = optical_depth_along(eye, from_elevation(std::max(elevation, 0.0f), 0.0f)) *
                     Vec3{p.air_density, p.dust_density, 0.0f};
  SpectralArray spectrum;
  for (size_t i = 0; i < k_wavelengths; ++i)
    spectrum[i] = spectra().sun[i] * std::exp(-extinction(depth, i)) / solid_angle;
  return to_xyz(spectrum);
}

// Past the zenith the sun comes down on the other side. The rotation ends in (0, 2 pi].
NishitaParameters in_range(NishitaParameters p) {
  p.sun_elevation = std::remainder(p.sun_elevation, k_two_pi);
  if (std::abs(p.sun_elevation) >= k_half_pi) {
    p.sun_elevation = std::copysign(k_pi, p.sun_elevation) - p.sun_elevation;
    p.sun_rotation += k_pi;
  }
  p.sun_rotation = std::fmod(p.sun_rotation, k_two_pi);
  if (p.sun_rotation < 0.0f) p.sun_rotation += k_two_pi;
  p.sun_rotation = k_two_pi - p.sun_rotation;
  // At the ground, and out in space, the integrals above break down.
  p.altitude = std::clamp(p.altitude, 1.0f, 59999.0f);
  p.sun_size = std::max(p.sun_size, 0.0005f);
  return p;
}

}  // namespace

NishitaSky::NishitaSky(const NishitaParameters& parameters)
    : p_(in_range(parameters)), table_(k_width * k_height) {
  to_sun_ = from_elevation(p_.sun_elevation, p_.sun_rotation + k_half_pi);
  const Vec3 eye{0.0f, 0.0f, k_earth_radius + p_.altitude};
  const Vec3 scale{p_.air_density, p_.dust_density, p_.ozone_density};
  const Vec3 sun_in_table = from_elevation(p_.sun_elevation, 0.0f);
  constexpr float k_half_row = 0.25f * k_pi / static_cast<float>(k_height);
  for (size_t y = 0; y < k_height; ++y) {
    // More rows toward the horizon; the sky is the same to both sides of the sun.
    const float elevation =
        (k_half_pi + k_half_row) * sqr(static_cast<float>(y) / static_cast<float>(k_height));
    for (size_t x = 0; x < k_width / 2; ++x) {
      const float azimuth = k_two_pi * static_cast<float>(x) / static_cast<float>(k_width) - k_pi;
      const Vec3 direction = from_elevation(elevation, azimuth);
      const Vec3 xyz = to_xyz(scattered_light(eye, direction, sun_in_table, scale));
      table_[y * k_width + x] = table_[y * k_width + (k_width - 1 - x)] = xyz;
    }
  }
  const float half = 0.5f * p_.sun_size;
  sun_bottom_ = disc_at(eye, p_.sun_elevation - half, p_);
  sun_top_ = disc_at(eye, p_.sun_elevation + half, p_);
}

std::shared_ptr<const NishitaSky> NishitaSky::make(const NishitaParameters& parameters) {
  static std::mutex mutex;
  static NishitaParameters last;
  static std::shared_ptr<const NishitaSky> sky;
  const std::lock_guard lock(mutex);
  if (!sky || !(last == parameters)) {
    sky = std::make_shared<const NishitaSky>(parameters);
    last = parameters;
  }
  return sky;
}

std::optional<SunDisk> NishitaSky::sun() const {
  if (!p_.sun_disc || p_.sun_elevation + 0.5f * p_.sun_size <= 0.0f) return {};
  return SunDisk{to_sun_, 0.5f * p_.sun_size};
}

// Bilinear between the centres of texels, which end at the edges.
Vec3 NishitaSky::table_at(float azimuth, float v) const {
  float u = (azimuth + k_pi + p_.sun_rotation) / k_two_pi;
  if (u > 1.0f) u -= 1.0f;
  const float x = std::clamp(u * k_width - 0.5f, 0.0f, k_width - 1.0f);
  const float y = std::clamp(v * k_height - 0.5f, 0.0f, k_height - 1.0f);
  const auto x0 = static_cast<size_t>(x), y0 = static_cast<size_t>(y);
  const size_t x1 = std::min(x0 + 1, k_width - 1), y1 = std::min(y0 + 1, k_height - 1);
  const float tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  const auto row = [&](size_t r) {
    return table_[r * k_width + x0] * (1.0f - tx) + table_[r * k_width + x1] * tx;
  };
  return row(y0) * (1.0f - ty) + row(y1) * ty;
}

Vec3 NishitaSky::sun_xyz(float from_centre, float elevation) const {
  const float half = 0.5f * p_.sun_size;
  // The part above the horizon, from bottom to top.
  const float bottom = std::max(p_.sun_elevation - half, 0.0f), top = p_.sun_elevation + half;
  if (!(top > 0.0f)) return {};
  const float t = (elevation - bottom) / (top - bottom);
  const Vec3 disc = sun_bottom_ + (sun_top_ - sun_bottom_) * t;
  const float limb_darkening = 1.0f - 0.6f * (1.0f - safe_sqrt(1.0f - sqr(from_centre / half)));
  return disc * (p_.sun_intensity * limb_darkening);
}

Spectrum NishitaSky::radiance(Vec3 direction) const {
  const float azimuth = std::atan2(direction.x, direction.y);
  if (direction.z < 0.0f) {
    if (direction.z < -0.4f) return {};
    const float fade = 1.0f + 2.5f * direction.z;
    return visible_color(table_at(azimuth, 0.0f) * (fade * fade * fade));
  }
  const float elevation = k_half_pi - safe_acos(direction.z);
  if (p_.sun_disc) {
    // Exact for small angles, too.
    const float from_centre =
        2.0f * std::atan2(length(direction - to_sun_), length(direction + to_sun_));
    if (from_centre < 0.5f * p_.sun_size) return visible_color(sun_xyz(from_centre, elevation));
  }
  return visible_color(table_at(azimuth, safe_sqrt(elevation / k_half_pi)));
}

}  // namespace tenniel
