// SPDX-License-Identifier: Apache-2.0
#include "lights/environment.h"

#include <vector>

#include "math/frame.h"
#include "sampling/warp.h"
#include "shading/nodes/coordinates.h"

namespace tenniel {

Vec3 equirectangular_to_direction(Vec2 uv) {
  const float phi = (0.5f - uv.x) * k_two_pi, theta = (1.0f - uv.y) * k_pi;
  const float sine = std::sin(theta);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
}

EnvironmentLight::EnvironmentLight(const std::function<Spectrum(Vec3)>& radiance, int width,
                                   int height) {
  // Centre and corners of each cell: what is bright only between the centres keeps a density.
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  std::vector<float> corners((w + 1) * (h + 1)), values(w * h);
  double sum = 0.0, weight_sum = 0.0;
  const auto sample_at = [&](float x, float y) {
    const Vec2 uv{x / static_cast<float>(width), y / static_cast<float>(height)};
    const float value = mean(radiance(equirectangular_to_direction(uv)));
    return std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
  };
  for (size_t y = 0; y <= h; ++y)
    for (size_t x = 0; x <= w; ++x)
      corners[y * (w + 1) + x] = sample_at(static_cast<float>(x), static_cast<float>(y));
  for (size_t y = 0; y < h; ++y) {
    const float sine = std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(height) * k_pi);
    for (size_t x = 0; x < w; ++x) {
      const float* c = &corners[y * (w + 1) + x];
      const float center = sample_at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float value = 0.5f * center + 0.125f * (c[0] + c[1] + c[w + 1] + c[w + 2]);
      values[y * w + x] = value * sine;
      sum += static_cast<double>(value) * sine;
      weight_sum += sine;
    }
  }
  map_ = Distribution2D(values, width, height);
  mean_ = static_cast<float>(sum / weight_sum);
}

std::optional<EnvironmentLight::Direction> EnvironmentLight::sample(const ShadingPoint& point,
                                                                    Vec2 u) const {
  if (is_constant()) {
    if (!point.has_hemisphere) return Direction{warp_uniform_sphere(u), uniform_sphere_pdf()};
    const Vec3 local = warp_cosine_hemisphere(u);
    if (!(local.z > 0.0f)) return {};
    return Direction{Frame::from_normal(point.normal).to_world(local),
                     cosine_hemisphere_pdf(local.z)};
  }
  const Distribution2D::Sample s = map_.sample(u);
  const float sine = std::sin(s.position.y * k_pi);
  if (!(sine > 0.0f) || !(s.pdf > 0.0f)) return {};
  return Direction{equirectangular_to_direction(s.position), s.pdf / (2.0f * k_pi * k_pi * sine)};
}

float EnvironmentLight::pdf(const ShadingPoint& point, Vec3 wi) const {
  if (is_constant())
    return point.has_hemisphere ? cosine_hemisphere_pdf(dot(wi, point.normal))
                                : uniform_sphere_pdf();
  const float sine = safe_sqrt(1.0f - sqr(wi.z));
  if (!(sine > 0.0f)) return 0.0f;
  return map_.pdf(equirectangular_projection(wi)) / (2.0f * k_pi * k_pi * sine);
}

}  // namespace tenniel
