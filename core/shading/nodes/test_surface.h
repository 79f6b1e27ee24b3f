// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "geometry/interaction.h"
#include "shading/material.h"

namespace tenniel {

// One triangle of the plane z = 0 with the UV map "" (u = x, v = y) and its tangents, placed by any
// transform: a surface for tests of nodes that read geometry.
class TestSurface {
 public:
  explicit TestSurface(AttributeIds& ids, const Transform& placed = {}) {
    mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh_.corners_per_face = 3;
    mesh_.face_vertices = mesh_.face_corners = {0, 1, 2};
    mesh_.attributes.push_back({"", AttributeDomain::corner, 2, {0, 0, 1, 0, 0, 1}});
    const Attribute uv = mesh_.attributes.front();
    add_tangents(mesh_, uv, ".tangent");
    for (size_t i = 0; i < mesh_.attributes.size(); ++i) {
      const auto id = static_cast<size_t>(ids.intern(mesh_.attributes[i].name));
      if (mesh_.slot_of_attribute.size() <= id) mesh_.slot_of_attribute.resize(id + 1, -1);
      mesh_.slot_of_attribute[id] = static_cast<int16_t>(i);
    }
    instance_.object_to_world = placed;
    instance_.world_to_object = placed.inverse();
    instance_.texture_space_size = {1, 1, 1};
  }

  // The point at object-space (x, y), looked at from `wo` (world space, unit).
  SurfaceInteraction at(float x, float y, Vec3 wo, float footprint = 0.01f) const {
    Ray ray;
    ray.direction = -wo;
    Hit hit;
    hit.u = x;
    hit.v = y;
    hit.t = 1.0f;
    return make_interaction(ray, hit, instance_, mesh_, footprint);
  }

 private:
  Mesh mesh_;
  Instance instance_;
};

}  // namespace tenniel
