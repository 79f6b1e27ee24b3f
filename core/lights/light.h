// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "geometry/visibility.h"
#include "lights/area.h"
#include "lights/environment.h"
#include "lights/mesh_light.h"
#include "lights/point.h"
#include "lights/spot.h"
#include "lights/sun.h"

namespace tenniel {

// Anything that next-event estimation may aim at. The world is a light like any other.
using LightShape =
    std::variant<PointLight, SpotLight, AreaLight, SunLight, MeshLight, EnvironmentLight>;

struct Material;

struct Light {
  std::string name;
  LightShape shape;
  Visibility visibility;               // worlds and ray kinds; a mesh light's is its object's
  const Material* material = nullptr;  // a lamp's node tree; null: the shape's radiance is all
  bool casts_shadow = true;
  bool use_mis = true;  // a lamp off MIS is met by no ray
  int max_bounces = 1024;

  // Not a mesh, nor the environment.
  bool is_lamp() const { return as<MeshLight>() == nullptr && as<EnvironmentLight>() == nullptr; }

  template <class Shape>
  const Shape* as() const {
    return std::get_if<Shape>(&shape);
  }
};

// As std::visit, which calls through a table that the compiler does not see through.
template <size_t first = 0, class F>
decltype(auto) visit_shape(const F& f, const LightShape& shape) {
  if constexpr (first + 1 == std::variant_size_v<LightShape>) {
    return f(*std::get_if<first>(&shape));
  } else {
    if (shape.index() == first) return f(*std::get_if<first>(&shape));
    return visit_shape<first + 1>(f, shape);
  }
}

// A lamp with a surface that rays can meet: it does not stop them.
bool is_hittable(const Light& light);
// Toward a lamp; empty for mesh lights and the environment, whose radiance takes a shader.
inline std::optional<LightSample> sample_lamp(const Light& light, const ShadingPoint& point,
                                              Vec2 u) {
  return visit_shape(
      [&]<class Shape>(const Shape& lamp) {
        if constexpr (std::is_same_v<Shape, MeshLight> || std::is_same_v<Shape, EnvironmentLight>)
          return std::optional<LightSample>();
        else
          return lamp.sample(point, u);
      },
      light.shape);
}
inline std::optional<LampHit> intersect_lamp(const Light& light, const Ray& ray) {
  return visit_shape(
      [&]<class Shape>(const Shape& lamp) {
        if constexpr (std::is_same_v<Shape, MeshLight> || std::is_same_v<Shape, EnvironmentLight>)
          return std::optional<LampHit>();
        else
          return lamp.intersect(ray);
      },
      light.shape);
}
// Density with which `sample_lamp` draws `wi`, a direction that meets the lamp.
float lamp_pdf(const Light& light, const ShadingPoint& point, Vec3 wi);

// The middle of a light that is somewhere.
std::optional<Vec3> center_of(const Light& light);

// An estimate of the irradiance that `light` may cause at `point`, never 0 where it may cause any:
// the weight of choosing it.
float light_importance(const Light& light, const ShadingPoint& point);

}  // namespace tenniel
