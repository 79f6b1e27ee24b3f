// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "shading/nodes/test_surface.h"
#include "shading/ray_queries.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

// A wall fills x < 0; the object itself has a ground and, seen by probes along x, a side.
class Wall final : public RayQueries {
 public:
  bool is_free(const SurfaceInteraction&, Vec3 direction, float distance, WorldIndex,
               bool own_only) const override {
    return own_only || direction.x > 0.0f || distance < near;
  }
  size_t own_hits(const SurfaceInteraction& from, const Ray& ray,
                  std::span<OwnHit> hits) const override {
    const bool is_from_above = std::abs(ray.direction.z) > 0.5f;
    const Vec3 n = is_from_above ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    hits[0] = {from.position, n, n};
    return 1;
  }
  float near = 0.0f;  // metres to the wall, whatever the direction
};

Spectrum emitted(const char* node, const RayQueries* rays) {
  const TestMaterial m(std::string(node) + "\ne: ShaderNodeEmission Color<node." +
                       (std::string(node).find("Bevel") == std::string::npos ? "Color" : "Normal") +
                       "\nout: ShaderNodeOutputMaterial Surface<e.Emission");
  AttributeIds ids;
  const TestSurface surface(ids);
  ShadingContext context;
  context.surface = surface.at(0.3f, 0.3f, {0.0f, 0.0f, 1.0f});
  context.rays = rays;
  m.run(m.material.surface, k_query_surface, context);
  return context.emission;
}

TEST(AmbientOcclusion, IsTheFreeShareOfTheHemisphere) {
  const Wall wall;
  const char* node = "node: ShaderNodeAmbientOcclusion Color=0.5,1,0.25";
  const Spectrum shaded = emitted(node, &wall);
  EXPECT_NEAR(shaded.g, 0.5f, 0.2f);
  EXPECT_FLOAT_EQ(shaded.r, 0.5f * shaded.g);
  EXPECT_FLOAT_EQ(shaded.b, 0.25f * shaded.g);
}

TEST(AmbientOcclusion, WithoutADistanceReachesAsFarAsTheWorldSays) {
  Wall wall;
  wall.near = 2.0f;
  const char* node = "node: ShaderNodeAmbientOcclusion Distance=0";
  wall.occlusion_distance = 1.0f;
  EXPECT_EQ(emitted(node, &wall), Spectrum(1.0f));
  wall.occlusion_distance = 3.0f;
  EXPECT_LT(emitted(node, &wall).g, 0.9f);
}

TEST(AmbientOcclusion, IsFullWhereNothingCanBeMet) {
  EXPECT_EQ(emitted("node: ShaderNodeAmbientOcclusion", nullptr), Spectrum(1.0f));
  const Wall wall;
  EXPECT_EQ(emitted("node: ShaderNodeAmbientOcclusion Distance=-1", &wall), Spectrum(1.0f));
}

TEST(Bevel, MixesTheNormalsAround) {
  const Wall wall;
  const Spectrum n = emitted("node: ShaderNodeBevel Radius=0.1", &wall);
  EXPECT_GT(n.b, 0.2f);
  EXPECT_NEAR(n.r * n.r + n.g * n.g + n.b * n.b, 1.0f, 1e-5f);
}

TEST(Bevel, LeavesTheNormalWithoutRadiusOrRays) {
  const Wall wall;
  const Spectrum plain = emitted("node: ShaderNodeBevel Radius=0", &wall);
  EXPECT_EQ(emitted("node: ShaderNodeBevel Radius=0.1", nullptr), plain);
}

}  // namespace
}  // namespace tenniel
