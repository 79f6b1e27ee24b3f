// SPDX-License-Identifier: Apache-2.0
#include "integrator/radiance_cache.h"

#include <gtest/gtest.h>

#include "integrator/path_recorder.h"

namespace tenniel {
namespace {

constexpr Vec3 k_up{0.0f, 0.0f, 1.0f};

// Fills a 10 m cube with records whose radiance depends on the half of space, the side, the world.
std::vector<RadianceRecord> room_of_records() {
  constexpr int k_places = 80000;
  std::vector<RadianceRecord> records;
  records.reserve(3 * k_places);
  for (int i = 0; i < k_places; ++i) {
    const int column = i % 100, row = i / 100 % 80, layer = i / 8000;
    const Vec3 p{static_cast<float>(column) / 10.0f, static_cast<float>(row) / 8.0f,
                 static_cast<float>(layer)};
    const float value = (p.x < 5.0f ? 1.0f : 3.0f) * ((i + i / 100) % 2 ? 0.5f : 1.5f);
    records.push_back({p, k_up, 0, Spectrum(value, 0.0f, 0.0f)});
    records.push_back({p, -k_up, 0, Spectrum(8.0f)});
    records.push_back({p, k_up, 1, Spectrum()});
  }
  return records;
}

TEST(RadianceCache, KnowsTheMeanOfEachNeighbourhood) {
  const RadianceCache cache(room_of_records());
  const RadianceCache::Guess* left = cache.find({1.0f, 5.0f, 5.0f}, k_up, 0);
  ASSERT_NE(left, nullptr);
  EXPECT_NEAR(left->from_surfaces.r, 1.0f, 0.05f);
  EXPECT_EQ(left->from_surfaces.g, 0.0f);
  const RadianceCache::Guess* right = cache.find({9.0f, 5.0f, 5.0f}, k_up, 0);
  ASSERT_NE(right, nullptr);
  EXPECT_NEAR(right->from_surfaces.r, 3.0f, 0.15f);
  const RadianceCache::Guess* below = cache.find({9.0f, 5.0f, 5.0f}, -k_up, 0);
  ASSERT_NE(below, nullptr);
  EXPECT_NEAR(below->from_surfaces.b, 8.0f, 1e-4f);
}

TEST(RadianceCache, SaysNothingWhereItKnowsNothing) {
  const RadianceCache cache(room_of_records());
  EXPECT_EQ(cache.find({5.0f, 5.0f, 90.0f}, k_up, 0), nullptr);               // no path was there
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, {1.0f, 0.0f, 0.0f}, 0), nullptr);  // on no such side
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, k_up, 1), nullptr);                // no light found
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, k_up, 4), nullptr);                // no such world
  EXPECT_EQ(cache.find({1e9f, -1e9f, 1e9f}, k_up, 0), nullptr);
  EXPECT_EQ(RadianceCache({}).find({}, k_up, 0), nullptr);
}

TEST(RadianceCache, OneFarVertexDoesNotStretchTheCells) {
  std::vector<RadianceRecord> records = room_of_records();
  records.push_back({{1e8f, 0.0f, 0.0f}, k_up, 0, Spectrum(1.0f)});
  const RadianceCache cache(records);
  EXPECT_NEAR(cache.find({1.0f, 5.0f, 5.0f}, k_up, 0)->from_surfaces.r, 1.0f, 0.05f);
}

TEST(RadianceCache, RecordsInOnePlaceAreOneCell) {
  const std::vector<RadianceRecord> records(100, {{1, 2, 3}, k_up, 2, Spectrum(0.5f)});
  const RadianceCache cache(records);
  ASSERT_NE(cache.find({1, 2, 3}, k_up, 2), nullptr);
  EXPECT_FLOAT_EQ(cache.find({1, 2, 3}, k_up, 2)->from_surfaces.g, 0.5f);
}

TEST(RadianceCache, KnowsWhereTheWorldCountsAndKeepsItApart) {
  std::vector<RadianceRecord> records;
  for (int i = 0; i < 40; ++i) {
    records.push_back({{0, 0, 0}, k_up, 0, Spectrum(1.0f)});
    records.push_back({{9, 0, 0}, k_up, 0, Spectrum(1.0f)});
    if (i % 4) continue;
    records.push_back({{0, 0, 0}, k_up, 0, Spectrum(2.0f), 1.0f, true});
    records.push_back({{9, 0, 0}, k_up, 0, Spectrum(0.1f), 1.0f, true});
  }
  const RadianceCache cache(records);
  const RadianceCache::Guess* bright = cache.find({0, 0, 0}, k_up, 0);
  const RadianceCache::Guess* dim = cache.find({9, 0, 0}, k_up, 0);
  ASSERT_TRUE(bright && dim);
  EXPECT_TRUE(bright->sees_world);
  EXPECT_FALSE(dim->sees_world);
  EXPECT_FLOAT_EQ(bright->from_surfaces.r, 1.0f);
  EXPECT_FLOAT_EQ(dim->from_surfaces.r, 1.0f);
}

TEST(PathRecorder, ARecordIsWhatCameAfterTheBounceOverItsThroughput) {
  PathRecorder recorder;
  recorder.begin();
  const RadianceRecord where{{}, k_up, 0, {}};
  recorder.diffuse_bounce(where, Spectrum(0.5f, 0.25f, 0.0f), Spectrum(1.0f));
  recorder.diffuse_bounce(where, Spectrum(0.1f), Spectrum(2.0f));
  std::vector<Spectrum> found;
  recorder.finish(Spectrum(3.0f), [&](const RadianceRecord& r) { found.push_back(r.radiance); });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], Spectrum(4.0f, 8.0f, 0.0f));
  EXPECT_FLOAT_EQ(found[1].r, 10.0f);
}

TEST(PathRecorder, TheLastBounceMayLeaveTheScene) {
  PathRecorder recorder;
  recorder.begin();
  const RadianceRecord where{{}, k_up, 0, {}};
  EXPECT_TRUE(recorder.diffuse_bounce(where, Spectrum(1.0f), Spectrum()));
  EXPECT_TRUE(recorder.diffuse_bounce(where, Spectrum(0.5f), Spectrum(1.0f)));
  recorder.leave_scene();
  std::vector<bool> left;
  recorder.finish(Spectrum(2.0f),
                  [&](const RadianceRecord& r) { left.push_back(r.has_left_scene); });
  EXPECT_EQ(left, (std::vector<bool>{false, true}));
}

}  // namespace
}  // namespace tenniel
