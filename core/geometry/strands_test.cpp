// SPDX-License-Identifier: Apache-2.0
#include "geometry/strands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/accel.h"
#include "geometry/test_shapes.h"
#include "math/numeric.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace tenniel {
namespace {

using test::place;

const std::atomic<bool> k_not_cancelled{false};

struct Hairs {
  std::vector<float> positions, radii;
  std::vector<int32_t> sizes;

  void add(const std::vector<StrandKey>& keys) {
    for (const StrandKey& k : keys) {
      positions.insert(positions.end(), {k.position.x, k.position.y, k.position.z});
      radii.push_back(k.radius);
    }
    sizes.push_back(static_cast<int32_t>(keys.size()));
  }
  StrandSoup soup(Shape shape) const {
    StrandSoup s;
    s.shape = shape;
    s.positions = positions.data();
    s.radii = radii.data();
    s.key_count = radii.size();
    s.sizes = sizes.data();
    s.strand_count = sizes.size();
    s.ribbon_pieces = 5;
    return s;
  }
};

// From z = -1 to 1 along the axis.
Hairs straight(float radius) {
  Hairs hairs;
  std::vector<StrandKey> keys;
  keys.reserve(5);
  for (int i = 0; i < 5; ++i)
    keys.push_back({{0.0f, 0.0f, -1.0f + 0.5f * static_cast<float>(i)}, radius});
  hairs.add(keys);
  return hairs;
}

struct World {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::shared_ptr<const Accel> accel;

  World(Mesh mesh, const Transform& to_world, bool is_world_space) {
    meshes.push_back(std::move(mesh));
    instances.push_back(place(0, to_world));
    if (is_world_space) move_to_world_space(meshes[0], to_world);
    accel = Accel::build(meshes, instances, k_not_cancelled);
  }
  std::optional<SurfaceInteraction> trace(const Ray& ray) const {
    const auto hit = accel->intersect(ray, ~0u);
    if (!hit) return {};
    return make_interaction(ray, *hit, instances[0], meshes[0], 0.0f);
  }
};

Transform turned_and_moved() {
  Transform m;
  m.x = {0.0f, 3.0f, 0.0f};
  m.y = {0.0f, 0.0f, 3.0f};
  m.z = {3.0f, 0.0f, 0.0f};
  m.translation = {5.0f, -2.0f, 1.0f};
  return m;
}

Ray ray_toward(LocalRandom& random, float spread) {
  Ray ray;
  const Vec3 aim =
      (warp_uniform_sphere(random.get_2d()) * spread) + Vec3{0, 0, random.get_1d() - 0.5f};
  ray.origin = warp_uniform_sphere(random.get_2d()) * 4.0f;
  ray.direction = normalize(aim - ray.origin);
  return ray;
}

// Entry into the infinite cylinder around z.
std::optional<float> into_cylinder(const Ray& ray, float radius) {
  const double dx = ray.direction.x, dy = ray.direction.y, x = ray.origin.x, y = ray.origin.y;
  const double a = dx * dx + dy * dy, b = x * dx + y * dy;
  const double c = x * x + y * y - double{radius} * radius;
  const double root = b * b - a * c;
  if (root < 0.0) return {};
  return static_cast<float>((-b - std::sqrt(root)) / a);
}

TEST(Strands, TubeIsACylinder) {
  const float radius = 0.1f;
  const World w(build_strands(straight(radius).soup(Shape::tubes)), {}, false);
  LocalRandom random(1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = ray_toward(random, 0.3f);
    const auto t = into_cylinder(ray, radius);
    const auto at = w.trace(ray);
    if (t && std::abs(ray.at(*t).z) > 0.99f) continue;  // its ends
    const double grazing = t ? dot(ray.direction, ray.at(*t) * Vec3{10, 10, 0}) : 0.0;
    if (t && grazing > -0.05) continue;
    ASSERT_EQ(at.has_value(), t.has_value()) << i;
    if (!t) continue;
    ++hits;
    ASSERT_NEAR(at->t, *t, 2e-4f);
    const Vec3 p = ray.at(*t);
    ASSERT_LT(length(at->shading_normal - normalize(Vec3{p.x, p.y, 0})), 5e-3f);
    ASSERT_EQ(at->geometric_normal, at->shading_normal);
    ASSERT_FALSE(at->is_back_facing);
  }
  EXPECT_GT(hits, 3000);
}

TEST(Strands, RibbonIsAsWideAsACylinderAndShadedLikeOne) {
  const float radius = 0.1f;
  const World w(build_strands(straight(radius).soup(Shape::ribbons)), {}, false);
  LocalRandom random(2);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = ray_toward(random, 0.3f);
    const Vec3 axis{0, 0, 1};
    const Vec3 side = normalize(cross(axis, -ray.direction));
    const float off = dot(ray.origin, side) / radius;  // how far the ray passes the axis
    if (std::abs(ray.direction.z) > 0.9f) continue;
    const float t =
        -dot(ray.origin, Vec3{ray.direction.x, ray.direction.y, 0}) / (1.0f - sqr(ray.direction.z));
    if (std::abs(ray.at(t).z) > 0.95f || std::abs(std::abs(off) - 1.0f) < 1e-3f) continue;
    const auto at = w.trace(ray);
    ASSERT_EQ(at.has_value(), std::abs(off) < 1.0f) << i;
    if (!at) continue;
    ++hits;
    ASSERT_NEAR(at->v, off, 2e-3f);
    const Vec3 front = normalize(at->wo - axis * dot(axis, at->wo));
    const Vec3 round = side * off + front * safe_sqrt(1.0f - sqr(off));
    ASSERT_LT(length(at->shading_normal - round), 0.1f);
    ASSERT_NEAR(dot(at->shading_normal, side), off, 2e-3f);
    ASSERT_EQ(at->geometric_normal, at->wo);
  }
  EXPECT_GT(hits, 3000);
}

// Flattened into world space or as an instance: the same points.
TEST(Strands, InstancesAndWorldSpaceAgree) {
  Hairs hairs;
  hairs.add({{{0, 0, 0}, 0.05f}, {{0.3f, 0.1f, 0.4f}, 0.04f}, {{0.2f, 0.5f, 0.8f}, 0.02f}});
  hairs.add({{{0.5f, 0, 0}, 0.05f}, {{0.3f, -0.4f, 0.5f}, 0.0f}});
  const Transform m = turned_and_moved();
  ASSERT_TRUE(keeps_shape(m));
  for (const Shape shape : {Shape::ribbons, Shape::tubes}) {
    const World placed(build_strands(hairs.soup(shape)), m, false);
    const World flat(build_strands(hairs.soup(shape)), m, true);
    LocalRandom random(3);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      Ray ray = ray_toward(random, 0.5f);
      const Vec3 aim = m.point(ray.origin + ray.direction * 4.0f);
      ray.origin = m.point(ray.origin);
      ray.direction = normalize(aim - ray.origin);
      const auto a = placed.trace(ray), b = flat.trace(ray);
      if (!a || !b) continue;  // at an outline rounding decides
      ++hits;
      ASSERT_LT(length(a->position - b->position), 2e-3f);
      ASSERT_GT(dot(a->shading_normal, b->shading_normal), 0.9f);
      ASSERT_EQ(a->face, b->face);
      ASSERT_NEAR(strand_thickness(*b), 3.0f * strand_thickness(*a), 3e-3f);
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(Strands, AttributesLieOnKeysAndHairs) {
  Hairs hairs = straight(0.1f);
  hairs.add({{{2, 0, -1}, 0.1f}, {{2, 0, 1}, 0.1f}});
  Mesh mesh = build_strands(hairs.soup(Shape::tubes));
  const StrandLengths lengths = measure_strands(hairs.soup(Shape::tubes));
  ASSERT_EQ(lengths.intercepts, (std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1, 0, 1}));
  ASSERT_EQ(lengths.lengths, (std::vector<float>{2, 2}));
  Attribute keys{"keys", AttributeDomain::vertex, 1, lengths.intercepts};
  Attribute each{"each", AttributeDomain::face, 1, {5.0f, 7.0f}};
  const World w(std::move(mesh), {}, false);
  for (const float x : {0.0f, 2.0f}) {
    for (const float z : {-0.7f, -0.2f, 0.3f}) {
      Ray ray;
      ray.origin = {x, -3.0f, z};
      ray.direction = {0, 1, 0};
      const auto at = w.trace(ray);
      ASSERT_TRUE(at);
      EXPECT_EQ(interpolate(each, *at)[0], x > 1.0f ? 7.0f : 5.0f);
      // Between keys the spline runs at its own speed.
      EXPECT_NEAR(interpolate(keys, *at)[0], 0.5f * (z + 1.0f), 0.06f);
      const float before = interpolate(keys, *at)[0];
      const auto on = shifted(*at, {0.0f, 0.0f, 0.01f});
      EXPECT_GT(interpolate(keys, on)[0], before);
      const auto beside = shifted(*at, {0.01f, 0.0f, 0.0f});
      EXPECT_NEAR(interpolate(keys, beside)[0], before, 1e-5f);
    }
  }
}

TEST(Strands, BrokenKeysAreLeftOut) {
  constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
  Hairs hairs = straight(0.1f);
  hairs.add({{{2, 0, -1}, 0.1f}, {{k_nan, 0, 0}, 0.1f}, {{2, 0, 1}, -1.0f}});
  hairs.add({{{3, 0, 0}, 0.1f}});
  hairs.add({});
  hairs.sizes.back() = 1000;  // more than there are
  const Mesh mesh = build_strands(hairs.soup(Shape::ribbons));
  EXPECT_EQ(mesh.strands.segments.size(), 4u);
  EXPECT_EQ(mesh.dropped_faces, 2u);
  const World w(mesh, {}, false);
  Ray ray;
  ray.origin = {2.0f, -3.0f, -0.5f};
  ray.direction = {0, 1, 0};
  EXPECT_FALSE(w.trace(ray));
}

TEST(Strands, SpheresAreRound) {
  Hairs points;
  points.add({{{0, 0, 0}, 0.5f}, {{2, 0, 0}, 0.25f}, {{4, 0, 0}, -1.0f}});
  for (const bool is_world_space : {false, true}) {
    const Transform m = turned_and_moved();
    const World w(build_strands(points.soup(Shape::spheres)), m, is_world_space);
    Ray ray;
    ray.origin = m.point({2.1f, -4.0f, 0.1f});
    ray.direction = normalize(m.vector({0, 1, 0}));
    const auto at = w.trace(ray);
    ASSERT_TRUE(at);
    ASSERT_TRUE(is_on_sphere(*at));
    EXPECT_LT(length(sphere_center(*at) - m.point({2, 0, 0})), 1e-5f);
    EXPECT_NEAR(length(at->position - m.point({2, 0, 0})), 0.75f, 1e-5f);
    EXPECT_GT(dot(at->shading_normal, at->position - m.point({2, 0, 0})), 0.7499f);
    ray.origin = m.point({4.0f, -4.0f, 0.0f});
    EXPECT_FALSE(w.trace(ray));
  }
}

// Power laws of the way that is left; the last key may be closed.
TEST(Strands, TaperFollowsTheWayFromTheRoot) {
  const Hairs hairs = straight(0.0f);
  const StrandSoup soup = hairs.soup(Shape::ribbons);
  const auto expect = [&](const Taper& taper, float power) {
    const auto radii = tapered_radii(soup, taper);
    ASSERT_EQ(radii.size(), 5u);
    for (size_t i = 0; i < 5; ++i) {
      const float left = std::pow(1.0f - 0.25f * static_cast<float>(i), power);
      const bool is_closed = taper.closes_tip && i == 4;
      EXPECT_NEAR(radii[i], is_closed ? 0.0f : 0.1f + 0.9f * left, 1e-6f);
    }
  };
  expect({1.0f, 0.1f, 0.0f, false}, 1.0f);
  expect({1.0f, 0.1f, -0.5f, false}, 0.5f);
  expect({1.0f, 0.1f, 0.5f, true}, 2.0f);
}

TEST(Strands, UnevenScaleKeepsNoShape) {
  Transform m;
  EXPECT_TRUE(keeps_shape(m));
  m.z = {0.0f, 0.0f, 1.01f};
  EXPECT_FALSE(keeps_shape(m));
}

// Continuing from a hair, on either side, does not find it again.
// Embree overlooks ribbons near the start of a ray, not those near a surface that it passed
// through.
TEST(Strands, RaysThatPassThroughAHairMeetTheNext) {
  Hairs hairs = straight(0.1f);
  std::vector<StrandKey> second;
  second.reserve(5);
  for (int i = 0; i < 5; ++i)
    second.push_back({{0.0f, 0.15f, -1.0f + 0.5f * static_cast<float>(i)}, 0.1f});
  hairs.add(second);
  for (const Shape shape : {Shape::ribbons, Shape::tubes}) {
    const World world(build_strands(hairs.soup(shape)), Transform(), true);
    Ray ray;
    ray.origin = {0.02f, -3.0f, 0.1f};
    ray.direction = {0.0f, 1.0f, 0.0f};
    std::vector<uint32_t> met;
    FaceId left;
    while (const auto hit = world.accel->intersect(ray, ~0u, left)) {
      met.push_back(world.meshes[0].face_polygons[hit->face]);
      ASSERT_LE(met.size(), 2u);
      left = {hit->face, hit->instance};
      ray.behind += hit->t;
      ray.origin = ray.at(hit->t + 1e-5f);
    }
    EXPECT_EQ(met, (std::vector<uint32_t>{0, 1})) << static_cast<int>(shape);
  }
}

TEST(Strands, RaysLeaveTheHairTheyStartOn) {
  for (const Shape shape : {Shape::ribbons, Shape::tubes}) {
    const World w(build_strands(straight(1e-3f).soup(shape)), turned_and_moved(), false);
    LocalRandom random(5);
    int found = 0, tried = 0;
    for (int i = 0; i < 20000; ++i) {
      Ray ray = ray_toward(random, 2e-3f);
      const Transform m = turned_and_moved();
      const Vec3 aim = m.point(ray.origin + ray.direction * 4.0f);
      ray.origin = m.point(ray.origin);
      ray.direction = normalize(aim - ray.origin);
      const auto at = w.trace(ray);
      if (!at) continue;
      Ray on;
      on.direction = warp_uniform_sphere(random.get_2d());
      if (std::abs(on.direction.x) > 0.9f) continue;  // along the hair
      on.origin = offset_ray_origin(*at, on.direction);
      ++tried;
      found += w.trace(on).has_value();
    }
    EXPECT_GT(tried, 1000);
    EXPECT_LE(found, tried / 1000) << static_cast<int>(shape);
  }
}

}  // namespace
}  // namespace tenniel
