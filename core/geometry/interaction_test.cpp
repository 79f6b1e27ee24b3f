// SPDX-License-Identifier: Apache-2.0
#include "geometry/interaction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/accel.h"
#include "geometry/test_shapes.h"
#include "math/frame.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace tenniel {
namespace {

const std::atomic<bool> k_not_cancelled{false};

Transform rotation(Vec3 axis, float angle) {
  const Vec3 a = normalize(axis);
  const auto turned = [&](Vec3 v) {
    return v * std::cos(angle) + cross(a, v) * std::sin(angle) +
           a * (dot(a, v) * (1.0f - std::cos(angle)));
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

Transform scaling(Vec3 s) {
  return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}
Transform translation(Vec3 t) {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t};
}

// One sphere of radius 1 under a transform, as a true instance or flattened.
struct Placed {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::shared_ptr<const Accel> accel;

  Placed(const Transform& t, bool is_world_space) {
    meshes.push_back(test::sphere(1.0f, 32, 64));
    if (is_world_space) move_to_world_space(meshes[0], t);
    instances.push_back(test::place(0, t));
    accel = Accel::build(meshes, instances, k_not_cancelled);
  }
  std::optional<SurfaceInteraction> trace(const Ray& ray) const {
    const auto hit = accel->intersect(ray, ~0u);
    if (!hit) return {};
    return make_interaction(ray, *hit, instances[0], meshes[0], 0.5f);
  }
};

// The front of a sphere is its outside, whatever turns, shears or mirrors it, and the normals are
// those of the ellipsoid.
TEST(MakeInteraction, NormalsFollowTheTransform) {
  const Transform turned = rotation({1, 2, 3}, 1.0f);
  const Transform transforms[] = {
      turned, translation({5, -2, 1}) * turned * scaling({2, 0.5f, 1}), scaling({-1, 1, 1}),
      translation({0, 3, 0}) * scaling({-2, -2, -2}), turned * scaling({1, -3, 1})};
  for (const Transform& t : transforms) {
    for (const bool is_world_space : {false, true}) {
      const Placed placed(t, is_world_space);
      LocalRandom random(2);
      for (int i = 0; i < 500; ++i) {
        const Vec3 on_sphere = warp_uniform_sphere(random.get_2d());
        const Vec3 center = t.translation;
        const Vec3 outward = normalize(t.point(on_sphere) - center);
        for (const bool from_outside : {true, false}) {
          Ray ray{from_outside ? center + outward * 20.0f : center,
                  from_outside ? -outward : outward};
          const auto at = placed.trace(ray);
          ASSERT_TRUE(at);
          EXPECT_EQ(at->is_back_facing, !from_outside);
          EXPECT_GT(dot(at->geometric_normal, at->wo), 0.0f);
          EXPECT_NEAR(length(at->geometric_normal), 1.0f, 1e-5f);
          const Vec3 smooth = normal_to_world(*at, on_sphere);
          const Vec3 expected = from_outside ? smooth : -smooth;
          EXPECT_NEAR(distance(at->shading_normal, expected), 0.0f, 0.03f);
          EXPECT_NEAR(distance(normalize(interpolated_object_normal(*at)), on_sphere), 0.0f, 0.03f);
          EXPECT_NEAR(distance(at->position, ray.at(at->t)), 0.0f, 2e-4f);
          EXPECT_EQ(at->footprint, 0.5f);
        }
      }
    }
  }
}

TEST(MakeInteraction, FlatFacesShadeWithTheirGeometry) {
  Placed placed({}, false);
  placed.meshes[0].all_smooth = false;
  const auto at = placed.trace({{0.1f, 0.2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->shading_normal, at->geometric_normal);
  EXPECT_NEAR(distance(interpolated_object_normal(*at), at->geometric_normal), 0.0f, 1e-6f);
}

TEST(MakeInteraction, CornerNormalsWinOverVertexNormals) {
  Placed placed({}, false);
  Mesh& mesh = placed.meshes[0];
  mesh.corner_normals.assign(mesh.face_vertices.size(), Vec3{0.6f, 0.0f, 0.8f});
  const auto at = placed.trace({{0.1f, 0.2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(at);
  EXPECT_NEAR(distance(at->shading_normal, {0.6f, 0.0f, 0.8f}), 0.0f, 1e-6f);
}

TEST(MakeInteraction, AFaceWithoutAreaHasAUnitNormal) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.face_vertices = mesh.face_corners = {0, 1, 2};
  mesh.all_smooth = true;
  mesh.vertex_normals.assign(3, Vec3());
  const Instance instance = test::place(0);
  const auto at =
      make_interaction({{0, 0, 1}, {0, 0, -1}}, {1.0f, 0.2f, 0.2f, 0, 0}, instance, mesh, 0.0f);
  EXPECT_EQ(at.geometric_normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(at.shading_normal, (Vec3{0, 0, 1}));
  EXPECT_TRUE(is_finite(shifted(at, {0.1f, 0.0f, 0.0f}).position));
}

TEST(Interpolate, ReadsEveryDomain) {
  test::Polygons p;
  for (const Vec3 v :
       {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}, Vec3{0.5f, 2, 0}})
    p.add_vertex(v);
  p.add_polygon({0, 1, 2, 4, 3});  // a pentagon: three triangles of one polygon
  p.add_polygon({3, 2, 1});
  const Mesh mesh = build_mesh(p.soup());
  ASSERT_EQ(mesh.face_count(), 4u);
  const Instance instance = test::place(0);
  const Attribute by_face{"f", AttributeDomain::face, 4, {1, 2, 3, 0.25f, 5, 6, 7, 0.75f}};
  const Attribute by_vertex{"v", AttributeDomain::vertex, 1, {0, 10, 20, 30, 40}};
  const Attribute by_corner{
      "c", AttributeDomain::corner, 2, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};
  const Ray ray{{0, 0, 1}, {0, 0, -1}};
  const auto at = make_interaction(ray, {1.0f, 0.5f, 0.25f, 1, 0}, instance, mesh, 0.0f);
  EXPECT_EQ(interpolate(by_face, at)[3], 0.25f);
  // Triangle 1 of the fan: corners 0, 2, 3 = vertices 0, 2, 4.
  EXPECT_FLOAT_EQ(interpolate(by_vertex, at)[0], 0.5f * 20 + 0.25f * 40);
  EXPECT_EQ(interpolate(by_vertex, at)[1], 0.0f);
  EXPECT_EQ(interpolate(by_vertex, at)[3], 1.0f);
  EXPECT_FLOAT_EQ(interpolate(by_corner, at)[1], 0.25f * 1 + 0.5f * 5 + 0.25f * 7);
  const auto other = make_interaction(ray, {1.0f, 0.5f, 0.25f, 3, 0}, instance, mesh, 0.0f);
  EXPECT_EQ(interpolate(by_face, other)[0], 5.0f);
}

// Blender's halves of a quad: (0,1,2) and (0,2,3), or (0,1,3) and (1,2,3).
TEST(ParametricCoordinates, AreThoseOfBlendersTriangles) {
  struct Case {
    int first_of_fan;
    Vec2 place, expected;
  };
  for (const Case& c : {Case{0, {0.8f, 0.3f}, {0.2f, 0.5f}}, Case{0, {0.3f, 0.8f}, {0.2f, 0.3f}},
                        Case{1, {0.2f, 0.3f}, {0.5f, 0.2f}}, Case{1, {0.9f, 0.6f}, {0.4f, 0.5f}}}) {
    test::Polygons p;
    for (const Vec3 corner : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
      p.add_vertex(corner);
    p.add_polygon({0, 1, 2, 3}, c.first_of_fan);
    const std::vector<Mesh> meshes{build_mesh(p.soup())};
    const std::vector<Instance> instances{test::place(0)};
    const auto accel = Accel::build(meshes, instances, k_not_cancelled);
    const Ray down{{c.place.x, c.place.y, 1.0f}, {0.0f, 0.0f, -1.0f}};
    const auto hit = accel->intersect(down, ~0u);
    ASSERT_TRUE(hit);
    const Vec2 found =
        parametric_coordinates(make_interaction(down, *hit, instances[0], meshes[0], 0.0f));
    EXPECT_NEAR(found.x, c.expected.x, 1e-6f);
    EXPECT_NEAR(found.y, c.expected.y, 1e-6f);
  }
}

TEST(Shifted, MovesPositionAndWeightsTogether) {
  const Transform t = translation({3, 1, 2}) * rotation({1, 1, 0}, 0.7f) * scaling({2, -1, 0.5f});
  const Placed placed(t, false);
  const auto at = placed.trace({t.translation + Vec3{0.3f, 0.2f, 9}, {0, 0, -1}});
  ASSERT_TRUE(at);
  const Frame frame = Frame::from_normal(at->geometric_normal);
  for (const Vec3 offset : {frame.x * 0.05f, frame.y * -0.4f}) {
    const auto moved = shifted(*at, offset);
    Vec3 rebuilt;
    for (size_t i = 0; i < 3; ++i)
      rebuilt += moved.corner_points[i] * moved.weights[i];
    EXPECT_NEAR(distance(rebuilt, moved.position), 0.0f, 1e-4f);
    EXPECT_NEAR(distance(moved.position, at->position + offset), 0.0f, 1e-6f);
    EXPECT_FLOAT_EQ(moved.u, moved.weights[1]);
    EXPECT_FLOAT_EQ(moved.v, moved.weights[2]);
  }
}

// Rays that leave a surface must not meet it again, near the origin or ten thousand kilometres off.
TEST(OffsetRayOriginStatistics, RaysDoNotHitTheSurfaceTheyLeave) {
  const Vec3 places[] = {{0, 0, 0}, {1, 2, 3}, {1e3f, -2e3f, 10}, {1e7f, 1e7f, -1e7f}};
  for (const Vec3 at_place : places) {
    const float size = std::max(1.0f, 1e-3f * length(at_place));
    const Transform t =
        translation(at_place) * rotation({3, 1, 2}, 0.9f) * scaling({size, size, size});
    for (const bool is_world_space : {false, true}) {
      const Placed placed(t, is_world_space);
      LocalRandom random(6);
      int again = 0;
      for (int i = 0; i < 20000; ++i) {
        const Vec3 outward = warp_uniform_sphere(random.get_2d());
        const auto at = placed.trace({at_place + outward * (3.0f * size), -outward});
        ASSERT_TRUE(at);
        const Frame frame = Frame::from_normal(at->geometric_normal);
        const Vec3 wi = frame.to_world(warp_uniform_hemisphere(random.get_2d()));
        // A convex body: whatever leaves its front never returns.
        if (placed.trace({offset_ray_origin(*at, wi), wi})) ++again;
      }
      EXPECT_EQ(again, 0) << at_place.x << (is_world_space ? " world" : " instance");
    }
  }
}

// A mesh modelled far from its own origin, placed back near the world's.
TEST(OffsetRayOriginStatistics, CoversTheRoundingOfObjectSpace) {
  const Vec3 far{2e4f, -1e4f, 3e4f};
  std::vector<Mesh> meshes{test::sphere(5.0f, 32, 64)};
  for (Vec3& p : meshes[0].positions)
    p += far;
  const Transform turn = rotation({1, 2, 2}, 0.8f);
  std::vector<Instance> instances{test::place(0, turn * translation(-far))};
  const auto accel = Accel::build(meshes, instances, k_not_cancelled);
  LocalRandom random(9);
  int again = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 outward = warp_uniform_sphere(random.get_2d());
    const Ray ray{outward * 20.0f, -outward};
    const auto hit = accel->intersect(ray, ~0u);
    ASSERT_TRUE(hit);
    const auto at = make_interaction(ray, *hit, instances[0], meshes[0], 0.0f);
    const Vec3 wi =
        Frame::from_normal(at.geometric_normal).to_world(warp_cosine_hemisphere(random.get_2d()));
    if (accel->intersect({offset_ray_origin(at, wi), wi}, ~0u)) ++again;
  }
  EXPECT_EQ(again, 0);
}

TEST(OffsetRayOrigin, GoesToTheSideOfTheDirection) {
  const Vec3 n{0, 0, 1}, p{1, 2, 3};
  EXPECT_GT(offset_ray_origin(p, n, {0, 0, 1}).z, 3.0f);
  EXPECT_LT(offset_ray_origin(p, n, {0, 0, -1}).z, 3.0f);
  EXPECT_NEAR(offset_ray_origin(p, n, {0, 0, 1}).z, 3.0f, 1e-3f);
  EXPECT_LT(offset_ray_origin({0, 0, -1}, n, {0, 0, -1}).z, -1.0f);
}

}  // namespace
}  // namespace tenniel
