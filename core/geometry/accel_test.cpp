// SPDX-License-Identifier: Apache-2.0
#include "geometry/accel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/test_shapes.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace tenniel {
namespace {

using test::place;
using test::Polygons;

const std::atomic<bool> k_not_cancelled{false};
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

struct World {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::shared_ptr<const Accel> accel;

  void build() { accel = Accel::build(meshes, instances, k_not_cancelled); }
  std::optional<SurfaceInteraction> trace(const Ray& ray, uint32_t mask = ~0u) const {
    const auto hit = accel->intersect(ray, mask);
    if (!hit) return {};
    const Instance& instance = instances[hit->instance];
    return make_interaction(ray, *hit, instance, meshes[instance.mesh], 0.0f);
  }
};

World one_sphere(bool is_world_space) {
  World w;
  w.meshes.push_back(test::sphere(1.0f, 24, 48));
  if (is_world_space) move_to_world_space(w.meshes[0], {});
  w.instances.push_back(place(0));
  w.build();
  return w;
}

// A unit square in z = 0, split along the given diagonal.
Mesh square(int first_of_fan) {
  Polygons p;
  for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
    p.add_vertex(v);
  p.add_polygon({0, 1, 2, 3}, first_of_fan);
  return build_mesh(p.soup());
}

TEST(AccelStatistics, ASphereIsWatertightFromInside) {
  for (const bool is_world_space : {true, false}) {
    const World w = one_sphere(is_world_space);
    LocalRandom random(1);
    for (int i = 0; i < 200000; ++i) {
      Ray ray;
      ray.direction = warp_uniform_sphere(random.get_2d());
      ray.origin = warp_uniform_sphere(random.get_2d()) * (0.9f * random.get_1d());
      const auto at = w.trace(ray);
      ASSERT_TRUE(at);
      ASSERT_TRUE(at->is_back_facing);
      ASSERT_NEAR(length(at->position), 1.0f, 0.02f);
      ASSERT_TRUE(w.accel->occluded(ray, 1u));
    }
  }
}

// Rays aimed exactly at vertices and along edges must not slip through.
TEST(Accel, EdgesAndVerticesDoNotLeak) {
  const World w = one_sphere(true);
  const Mesh& mesh = w.meshes[0];
  for (size_t i = 0; i < mesh.face_vertices.size(); ++i) {
    const Vec3 a = mesh.positions[mesh.face_vertices[i]];
    const Vec3 b = mesh.positions[mesh.face_vertices[i / 4 * 4 + (i + 1) % 4]];
    for (const float t : {0.0f, 0.3f, 0.5f}) {
      Ray ray;
      ray.direction = normalize(a * (1.0f - t) + b * t);
      ASSERT_TRUE(w.accel->intersect(ray, 1u));
    }
  }
}

TEST(Accel, IntersectAllFindsCoincidentFaces) {
  World w;
  w.meshes.push_back(square(0));
  w.meshes.push_back(square(1));
  move_to_world_space(w.meshes[1], {});
  w.instances.push_back(place(0));
  w.instances.push_back(place(1));
  w.instances.push_back(place(0));
  w.build();
  std::array<Hit, 8> hits;
  // Through the diagonal too, where both halves of the face are met.
  for (const Vec2 p : {Vec2{0.3f, 0.6f}, Vec2{0.5f, 0.5f}}) {
    Ray ray{{p.x, p.y, 1.0f}, {0.0f, 0.0f, -1.0f}};
    ASSERT_EQ(w.accel->intersect_all(ray, 1u, hits), 3u);
    uint32_t seen = 0;
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_FLOAT_EQ(hits[i].t, 1.0f);
      seen |= 1u << hits[i].instance;
    }
    EXPECT_EQ(seen, 7u);
    EXPECT_EQ(w.accel->intersect_all(ray, 1u, std::span(hits).first(2)), 2u);
    ray.t_max = 0.5f;
    EXPECT_EQ(w.accel->intersect_all(ray, 1u, hits), 0u);
  }
}

// Notes what it is asked of, and lets the ray pass all instances but one.
struct OneBlocks final : Accel::Blocker {
  explicit OneBlocks(uint32_t which) : instance(which) {}
  bool blocks(const Hit& hit) override {
    met.push_back(hit);
    return hit.instance == instance;
  }
  uint32_t instance;
  std::vector<Hit> met;
};

TEST(Accel, AsksABlockerOfEachFace) {
  World w;
  w.meshes.push_back(square(0));
  for (int i = 0; i < 3; ++i)
    w.instances.push_back(
        place(0, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -static_cast<float>(i)}}));
  w.instances[2].visibility.bits = 2u;
  w.build();
  Ray ray{{0.3f, 0.6f, 1.0f}, {0.0f, 0.0f, -1.0f}};
  OneBlocks none(9);
  EXPECT_FALSE(w.accel->occluded(ray, 1u, none));
  ASSERT_EQ(none.met.size(), 2u) << "the third is not seen by this kind";
  for (const Hit& hit : none.met)
    EXPECT_FLOAT_EQ(hit.t, 1.0f + static_cast<float>(hit.instance));
  for (const uint32_t which : {0u, 1u}) {
    OneBlocks one(which);
    EXPECT_TRUE(w.accel->occluded(ray, 1u, one));
    EXPECT_EQ(one.met.back().instance, which) << "asked no more";
  }
  ray.t_max = 1.5f;
  OneBlocks second(1);
  EXPECT_FALSE(w.accel->occluded(ray, 1u, second));
  EXPECT_EQ(second.met.size(), 1u);
}

// The position as an attribute comes back as the position, on both halves of either diagonal.
TEST(Accel, QuadBarycentricsAgreeWithTheHitPoint) {
  for (const int first_of_fan : {0, 1}) {
    World w;
    w.meshes.push_back(square(first_of_fan));
    w.instances.push_back(place(0));
    w.build();
    Mesh& mesh = w.meshes[0];
    ASSERT_EQ(mesh.corners_per_face, 4);
    Attribute by_vertex{"v", AttributeDomain::vertex, 3, {}};
    for (const Vec3 p : mesh.positions)
      by_vertex.data.insert(by_vertex.data.end(), {p.x, p.y, p.z});
    // Bends the square: a value that only linear interpolation over Blender's triangles gives.
    const Attribute bend{"b", AttributeDomain::corner, 1, {0, 1, 0, 5}};
    LocalRandom random(3);
    for (int i = 0; i < 2000; ++i) {
      const Vec2 p = random.get_2d();
      const auto at = w.trace({{p.x, p.y, 1.0f}, {0.0f, 0.0f, -1.0f}});
      ASSERT_TRUE(at);
      EXPECT_NEAR(distance(at->position, {p.x, p.y, 0.0f}), 0.0f, 1e-6f);
      const auto value = interpolate(by_vertex, *at);
      EXPECT_NEAR(value[0], p.x, 1e-6f);
      EXPECT_NEAR(value[1], p.y, 1e-6f);
      EXPECT_EQ(value[3], 1.0f);
      const float along_02 = p.x > p.y ? p.x - p.y : 5.0f * (p.y - p.x);
      const float along_13 = p.x + p.y < 1.0f ? p.x + 5.0f * p.y : 6.0f - 5.0f * p.x - p.y;
      EXPECT_NEAR(interpolate(bend, *at)[0], first_of_fan == 0 ? along_02 : along_13, 1e-5f);
      EXPECT_FLOAT_EQ(at->geometric_normal.z, 1.0f);
      EXPECT_FALSE(at->is_back_facing);
    }
  }
}

TEST(Accel, MasksSelectByWorldAndKind) {
  World w;
  w.meshes.push_back(square(0));
  w.meshes.push_back(square(0));
  move_to_world_space(w.meshes[1], {});
  for (const uint32_t mesh : {0u, 1u}) {
    Instance instance = place(mesh);
    instance.visibility = Visibility::from_sets(0b10001u, 0b001010u);
    w.instances = {instance};
    w.build();
    const Ray ray{{0.3f, 0.6f, 1.0f}, {0.0f, 0.0f, -1.0f}};
    for (WorldIndex world = 0; world < k_world_count; ++world) {
      for (int k = 0; k < k_ray_kind_count; ++k) {
        const auto kind = static_cast<RayKind>(k);
        const bool expected = (world == 0 || world == 4) && (k == 1 || k == 3);
        EXPECT_EQ(w.accel->intersect(ray, ray_mask(world, kind)).has_value(), expected);
        EXPECT_EQ(w.accel->occluded(ray, ray_mask(world, kind)), expected);
      }
    }
    EXPECT_TRUE(w.accel->intersect_instance(ray, 0)) << "whatever its mask";
  }
}

TEST(Accel, InstancesKeepTheirIndices) {
  World w;
  w.meshes.push_back(test::sphere(0.4f));
  w.meshes.push_back(square(0));
  move_to_world_space(w.meshes[1], {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 0}});
  for (int i = 0; i < 4; ++i)
    w.instances.push_back(
        place(0, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {static_cast<float>(i), 0, 0}}));
  w.instances.push_back(place(1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 0}}));
  w.build();
  for (uint32_t i = 0; i < 4; ++i) {
    const auto hit = w.accel->intersect({{static_cast<float>(i), 0, 5}, {0, 0, -1}}, 1u);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->instance, i);
  }
  const auto hit = w.accel->intersect({{10.5f, 0.5f, 5}, {0, 0, -1}}, 1u);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->instance, 4u);
  const Bounds3 box = w.accel->bounds();
  EXPECT_NEAR(box.min.x, -0.4f, 1e-5f);
  EXPECT_NEAR(box.max.x, 11.0f, 1e-5f);
  EXPECT_GT(w.accel->memory_bytes(), 0u);
}

TEST(Accel, QueriesOneInstanceThroughOthers) {
  World w;
  w.meshes.push_back(square(0));
  w.meshes.push_back(square(0));
  w.meshes.push_back(square(0));
  const auto at_height = [](float z, float scale) {
    return Transform{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, {0, 0, z}};
  };
  move_to_world_space(w.meshes[0], at_height(2.0f, 1.0f));
  move_to_world_space(w.meshes[1], at_height(1.0f, 1.0f));
  w.instances = {place(0, at_height(2.0f, 1.0f)), place(1, at_height(1.0f, 1.0f)),
                 place(2, at_height(0.5f, 3.0f))};
  const Ray ray{{0.5f, 0.5f, 4.0f}, {0, 0, -1}};
  for (const bool is_searched_alone : {false, true}) {
    for (Instance& instance : w.instances)
      instance.is_searched_alone = is_searched_alone;
    w.build();
    for (uint32_t i = 0; i < 3; ++i) {
      const auto hit = w.accel->intersect_instance(ray, i);
      ASSERT_TRUE(hit) << i;
      EXPECT_EQ(hit->instance, i);
      EXPECT_FLOAT_EQ(hit->t, i == 0 ? 2.0f : i == 1 ? 3.0f : 3.5f);
      std::array<Hit, 4> hits;
      ASSERT_EQ(w.accel->intersect_all_of_instance(ray, i, w.instances[i].world_to_object, hits),
                1u);
      EXPECT_EQ(hits[0].instance, i);
      EXPECT_FLOAT_EQ(hits[0].t, hit->t);
    }
    EXPECT_FALSE(w.accel->intersect_instance(ray, 3));
    EXPECT_EQ(w.accel->intersect(ray, 1u)->instance, 0u) << "the top level is as it was";
  }
}

// Where an object moves, it is asked for at a time of its own.
TEST(Accel, QueriesOneInstanceWhereItIs) {
  World w;
  w.meshes.push_back(test::sphere(0.4f));
  w.instances = {place(0)};
  w.build();
  const Transform moved{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-3, 0, 0}};
  const Ray ray{{3.07f, 0.03f, 2.0f}, {0, 0, -1}};
  EXPECT_FALSE(w.accel->intersect_instance(ray, 0));
  const auto hit = w.accel->intersect_instance(ray, 0, &moved);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 1.6f, 0.02f);
  std::array<Hit, 4> hits;
  EXPECT_EQ(w.accel->intersect_all_of_instance(ray, 0, moved, hits), 2u) << "in and out";
}

TEST(Accel, SkipsWhatHasNoVolumeOfItsOwn) {
  World w;
  w.meshes.push_back(square(0));
  w.meshes.push_back(Mesh());
  Instance broken = place(0);
  broken.object_to_world.translation.x = k_nan;
  w.instances = {place(0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {}}), broken, place(1), place(9)};
  w.build();
  EXPECT_FALSE(w.accel->intersect({{0.5f, 0.5f, 1}, {0, 0, -1}}, ~0u));
  EXPECT_FALSE(w.accel->intersect_instance({{0.5f, 0.5f, 1}, {0, 0, -1}}, 0));
  EXPECT_TRUE(w.accel->bounds().is_empty());
}

TEST(Accel, AnEmptySceneIsMissed) {
  World w;
  w.build();
  EXPECT_FALSE(w.accel->intersect({{0, 0, 0}, {0, 0, 1}}, ~0u));
  EXPECT_FALSE(w.accel->occluded({{0, 0, 0}, {0, 0, 1}}, ~0u));
  EXPECT_TRUE(w.accel->bounds().is_empty());
}

TEST(Accel, RejectsAndCountsBrokenRays) {
  const World w = one_sphere(false);
  const float inf = k_infinity;
  const Ray broken[] = {{{k_nan, 0, 0}, {0, 0, 1}},    {{0, 0, inf}, {0, 0, 1}},
                        {{0, 0, 0}, {0, k_nan, 1}},    {{0, 0, 0}, {-inf, 0, 1}},
                        {{0, 0, 0}, {0, 0, 1}, k_nan}, {{0, 0, 0}, {0, 0, 1}, 0.0f, k_nan},
                        {{3e38f, 3e38f, 0}, {0, 0, 1}}};
  uint64_t count = 0;
  for (const Ray& ray : broken) {
    EXPECT_FALSE(w.accel->intersect(ray, ~0u));
    EXPECT_FALSE(w.accel->occluded(ray, ~0u));
    EXPECT_FALSE(w.accel->intersect_instance(ray, 0));
    EXPECT_EQ(w.accel->rejected_rays(), count += 3);
  }
  EXPECT_TRUE(w.accel->intersect({{0, 0, 0}, {0, 0, 1}}, ~0u));
  EXPECT_EQ(w.accel->rejected_rays(), count);
}

TEST(Accel, HonoursTheRaysInterval) {
  const World w = one_sphere(true);
  EXPECT_FALSE(w.accel->intersect({{0, 0, 0}, {0, 0, 1}, 0.0f, 0.9f}, 1u));
  EXPECT_FALSE(w.accel->occluded({{0, 0, 0}, {0, 0, 1}, 1.1f, 5.0f}, 1u));
  EXPECT_FALSE(w.accel->occluded({{0, 0, 0}, {0, 0, 1}, 2.0f, 1.0f}, 1u));
  const auto hit = w.accel->intersect({{0, 0, -3}, {0, 0, 1}, 3.0f}, 1u);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 4.0f, 1e-3f);
}

TEST(Accel, SurvivesDegenerateFaces) {
  Polygons p;
  for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
    p.add_vertex(v);
  p.add_polygon({0, 1, 2, 3});
  p.add_polygon({0, 0, 0, 0});
  p.add_polygon({0, 1, 1, 0});
  p.add_vertex({k_nan, k_nan, k_nan});
  p.add_vertex({1e38f, 0, 0});
  p.add_polygon({0, 1, 2, 4});
  p.add_polygon({0, 1, 2, 5});
  World w;
  w.meshes.push_back(build_mesh(p.soup()));
  EXPECT_EQ(w.meshes[0].dropped_faces, 2u);
  w.instances = {place(0)};
  w.build();
  const auto at = w.trace({{0.25f, 0.5f, 1}, {0, 0, -1}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->face, 0u);
}

// A Mesh that lost its room behind the last vertex is still read within its bounds.
TEST(Accel, TakesMeshesWithoutPadding) {
  World w;
  w.meshes.push_back(square(0));
  w.meshes[0].positions = std::vector<Vec3>(w.meshes[0].positions);
  w.meshes[0].positions.shrink_to_fit();
  ASSERT_EQ(w.meshes[0].positions.capacity(), w.meshes[0].positions.size());
  w.instances = {place(0)};
  w.build();
  EXPECT_TRUE(w.accel->intersect({{0.9f, 0.9f, 1}, {0, 0, -1}}, 1u));
}

TEST(Accel, ACancelledBuildComesBackEmpty) {
  World w;
  w.meshes.push_back(test::sphere(1.0f));
  w.instances = {place(0)};
  const std::atomic<bool> cancelled{true};
  const auto accel = Accel::build(w.meshes, w.instances, cancelled);
  ASSERT_TRUE(accel);
  EXPECT_FALSE(accel->intersect({{0, 0, 0}, {0, 0, 1}}, ~0u));
  EXPECT_FALSE(accel->intersect_instance({{0, 0, 0}, {0, 0, 1}}, 0));
  EXPECT_TRUE(accel->bounds().is_empty());
  EXPECT_EQ(accel->memory_bytes(), 0u);
}

TEST(Accel, KnowsItsEmbree) {
  EXPECT_EQ(Accel::embree_version().substr(0, 2), "3.");
}

}  // namespace
}  // namespace tenniel
