// SPDX-License-Identifier: Apache-2.0
#include "lights/light.h"

#include <algorithm>

namespace tenniel {

namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

// Intensity toward the point spread over the squared distance to a ball around the light, dimmed
// where the ball lies low above, or below, the horizon. Normal maps shade with other normals than
// the point's, hence the floor.
float ball_importance(float intensity, Vec3 center, float radius, const ShadingPoint& point) {
  const Vec3 to_center = center - point.position;
  const float distance_squared = std::max(length_squared(to_center), sqr(radius));
  if (!(distance_squared > 0.0f)) return intensity;
  float cosine_bound = 1.0f;
  if (point.has_hemisphere) {
    const float distance = std::sqrt(distance_squared);
    cosine_bound = std::clamp((dot(to_center, point.normal) + radius) / distance, 0.05f, 1.0f);
  }
  return intensity * cosine_bound / distance_squared;
}

float area_importance(const AreaLight& area, const ShadingPoint& point) {
  const Vec3 to_center = area.center - point.position;
  const float radius = 0.5f * length(area.edge_u + area.edge_v);
  const float distance = std::max(length(to_center), radius);
  const float facing = std::max(-dot(to_center, area.normal) / distance, 0.0f);
  // Points beside the lamp, within its extent, see it at a slant.
  const float slant = std::clamp(facing + radius / distance * 0.5f, 0.0f, 1.0f);
  if (dot(point.position - area.center, area.normal) <= 0.0f) return 0.0f;
  const float intensity =
      mean(area.radiance) * area.area() * slant * area.beam_estimate(point.position);
  return ball_importance(intensity, area.center, radius, point);
}

}  // namespace

bool is_hittable(const Light& light) {
  if (!light.use_mis) return false;
  return std::visit(Overloaded{
                        [](const PointLight& l) { return l.radius > 0.0f; },
                        [](const SpotLight& l) { return l.point.radius > 0.0f; },
                        [](const AreaLight&) { return true; },
                        [](const SunLight& l) { return l.disk_radius > 0.0f; },
                        [](const auto&) { return false; },
                    },
                    light.shape);
}

float lamp_pdf(const Light& light, const ShadingPoint& point, Vec3 wi) {
  return visit_shape(Overloaded{
                         [](const MeshLight&) { return 0.0f; },
                         [](const EnvironmentLight&) { return 0.0f; },
                         [&](const auto& lamp) { return lamp.pdf(point, wi); },
                     },
                     light.shape);
}

std::optional<Vec3> center_of(const Light& light) {
  if (const auto* point = light.as<PointLight>()) return point->position;
  if (const auto* spot = light.as<SpotLight>()) return spot->point.position;
  if (const auto* area = light.as<AreaLight>()) return area->center;
  if (const auto* mesh = light.as<MeshLight>()) return mesh->center();
  return std::nullopt;
}

float light_importance(const Light& light, const ShadingPoint& point) {
  const auto point_lamp = [&](const PointLight& l, float factor) {
    const float area = l.radius > 0.0f ? l.area() : 1.0f;
    return ball_importance(mean(l.radiance) * area * factor, l.position, l.radius, point);
  };
  return visit_shape(
      Overloaded{
          [&](const PointLight& l) { return point_lamp(l, 1.0f); },
          [&](const SpotLight& l) {
            const Vec3 from_lamp = normalize_or(point.position - l.point.position, l.axis);
            const float spread =
                l.point.radius /
                std::max(distance(point.position, l.point.position), l.point.radius + 1e-12f);
            const bool reached = dot(from_lamp, l.axis) > l.cos_half_angle - spread;
            return reached ? point_lamp(l.point, 1.0f) : 0.0f;
          },
          [&](const AreaLight& l) { return area_importance(l, point); },
          [&](const SunLight& l) {
            const float cosine =
                point.has_hemisphere ? dot(point.normal, l.axis) + l.disk_radius : 1.0f;
            return mean(l.irradiance) * std::clamp(cosine, 0.05f, 1.0f);
          },
          [&](const MeshLight& l) {
            return ball_importance(l.power(), l.center(), l.radius(), point);
          },
          [&](const EnvironmentLight& l) { return k_pi * l.mean_radiance(); },
      },
      light.shape);
}

}  // namespace tenniel
