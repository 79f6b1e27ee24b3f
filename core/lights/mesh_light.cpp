// SPDX-License-Identifier: Apache-2.0
#include "lights/mesh_light.h"

#include "math/bounds.h"
#include "sampling/warp.h"

namespace tenniel {

MeshLight::MeshLight(const Instance& instance, uint32_t instance_index, const Mesh& mesh,
                     const std::vector<float>& emission)
    : instance_(&instance),
      instance_index_(instance_index),
      mesh_(&mesh),
      halves_(mesh.corners_per_face - 2) {
  std::vector<float> weights(mesh.face_count() * static_cast<size_t>(halves_), 0.0f);
  Bounds3 bounds;
  for (uint32_t i = 0; i < weights.size(); ++i) {
    const auto slot = static_cast<size_t>(mesh.material_slot(i / static_cast<uint32_t>(halves_)));
    const float radiance = emission[std::min(slot, emission.size() - 1)];
    if (!(radiance > 0.0f)) continue;
    const Corners p = corners(i);
    const float area = 0.5f * length(cross(p.b - p.a, p.c - p.a));
    if (!(area > 1e-20f) || !std::isfinite(area)) continue;
    weights[i] = area * radiance;
    power_ += weights[i];
    bounds.add(p.a);
    bounds.add(p.b);
    bounds.add(p.c);
  }
  table_ = AliasTable(weights);
  if (!bounds.is_empty()) {
    center_ = bounds.center();
    radius_ = bounds.radius();
  }
}

MeshLight::Corners MeshLight::corners(uint32_t triangle) const {
  const auto halves = static_cast<uint32_t>(halves_);
  const FaceTriangle t = face_triangle(*mesh_, triangle / halves, triangle % halves == 1);
  Vec3 p[3];
  for (size_t i = 0; i < 3; ++i) {
    p[i] = mesh_->positions[t.vertices[i]];
    if (!mesh_->is_world_space) p[i] = instance_->object_to_world.point(p[i]);
  }
  return {p[0], p[1], p[2]};
}

std::optional<MeshLight::Point> MeshLight::sample(const ShadingPoint& point, Vec2 u) const {
  const AliasTable::Choice choice = table_.sample(u.x);
  const Corners p = corners(choice.index);
  const auto weights = warp_triangle({choice.remapped_u, u.y});
  const Vec3 on_light = p.a * weights[0] + p.b * weights[1] + p.c * weights[2];
  const Vec3 normal_area = cross(p.b - p.a, p.c - p.a);  // length = twice the area
  const Vec3 to_light = on_light - point.position;
  const float distance_squared = length_squared(to_light);
  const float distance = std::sqrt(distance_squared);
  const Vec3 wi = to_light / distance;
  const float projected_area = 0.5f * abs_dot(wi, normal_area);
  if (!(projected_area > 0.0f) || !(distance_squared > 0.0f)) return {};
  const bool second = halves_ == 2 && choice.index % 2 == 1;
  Hit hit;
  hit.t = distance;
  // Embree's square: the second half counts from the opposite corner.
  hit.u = second ? 1.0f - weights[1] : weights[1];
  hit.v = second ? 1.0f - weights[2] : weights[2];
  hit.face = choice.index / static_cast<uint32_t>(halves_);
  hit.instance = instance_index_;
  return Point{wi, distance, choice.probability * distance_squared / projected_area, hit};
}

float MeshLight::pdf(const SurfaceInteraction& at, Vec3 from) const {
  const bool second = halves_ == 2 && at.is_second_half;
  const uint32_t triangle = at.face * static_cast<uint32_t>(halves_) + (second ? 1u : 0u);
  const float probability = table_.probability(triangle);
  const Vec3 normal_area =
      cross(at.corner_points[1] - at.corner_points[0], at.corner_points[2] - at.corner_points[0]);
  const Vec3 to_light = at.position - from;
  const float distance_squared = length_squared(to_light);
  const float projected_area = 0.5f * abs_dot(to_light, normal_area) / std::sqrt(distance_squared);
  return projected_area > 0.0f ? probability * distance_squared / projected_area : 0.0f;
}

}  // namespace tenniel
