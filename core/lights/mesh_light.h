// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/interaction.h"
#include "lights/light_types.h"
#include "sampling/distribution.h"

namespace tenniel {

// The emissive faces of one instance. Triangles are chosen by area times an estimate of what they
// emit, points on them by area; both sides shine.
class MeshLight {
 public:
  // `emission`: mean radiance expected of each material slot; 0 leaves its faces out.
  // Pointers must outlive the light. Zero-area and non-finite triangles are never chosen.
  MeshLight(const Instance& instance, uint32_t instance_index, const Mesh& mesh,
            const std::vector<float>& emission);

  bool empty() const { return table_.empty(); }
  // A point on the light and its density; the radiance is left to the caller, who can shade.
  struct Point {
    Vec3 wi;
    float distance = 0.0f;
    float pdf = 0.0f;  // per solid angle
    Hit hit;
  };
  std::optional<Point> sample(const ShadingPoint& point, Vec2 u) const;
  // Density of a ray from `from` that met this light at `at`.
  float pdf(const SurfaceInteraction& at, Vec3 from) const;

  const Instance& instance() const { return *instance_; }
  const Mesh& mesh() const { return *mesh_; }
  // area * mean radiance, summed; and the ball around the light.
  float power() const { return power_; }
  Vec3 center() const { return center_; }
  float radius() const { return radius_; }

 private:
  struct Corners {
    Vec3 a, b, c;
  };
  Corners corners(uint32_t triangle) const;

  const Instance* instance_;
  uint32_t instance_index_;
  const Mesh* mesh_;
  int halves_;        // triangles a face: 1 or 2
  AliasTable table_;  // over face * halves + half
  float power_ = 0.0f;
  Vec3 center_;
  float radius_ = 0.0f;
};

}  // namespace tenniel
