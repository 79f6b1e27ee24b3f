// SPDX-License-Identifier: Apache-2.0
#include "integrator/radiance_cache.h"

#include <gtest/gtest.h>

#include "integrator/path_recorder.h"
#include "integrator/roulette.h"

namespace tenniel {
namespace {

constexpr Vec3 k_up{0.0f, 0.0f, 1.0f};

// Fills a 10 m cube with records whose radiance depends on the half of space, the side, the world.
std::vector<RadianceRecord> room_of_records() {
  constexpr int k_places = 80000;
  std::vector<RadianceRecord> records;
  records.reserve(3 * k_places);
  for (int i = 0; i < k_places; ++i) {
    const Vec3 p{static_cast<float>(i % 100) / 10.0f, static_cast<float>(i / 100 % 80) / 8.0f,
                 static_cast<float>(i / 8000)};
    const float value = (p.x < 5.0f ? 1.0f : 3.0f) * ((i + i / 100) % 2 ? 0.5f : 1.5f);
    records.push_back({p, k_up, 0, Spectrum(value, 0.0f, 0.0f)});
    records.push_back({p, -k_up, 0, Spectrum(8.0f)});
    records.push_back({p, k_up, 1, Spectrum()});
  }
  return records;
}

TEST(RadianceCache, KnowsMeanAndDeviationOfEachNeighbourhood) {
  const RadianceCache cache(room_of_records(), 2.0f);
  EXPECT_EQ(cache.picture_mean(), 2.0f);
  const CachedRadiance* left = cache.find({1.0f, 5.0f, 5.0f}, k_up, 0);
  ASSERT_NE(left, nullptr);
  EXPECT_NEAR(left->mean.r, 1.0f, 0.05f);
  EXPECT_EQ(left->mean.g, 0.0f);
  EXPECT_NEAR(left->deviation, 0.5f, 0.05f);
  const CachedRadiance* right = cache.find({9.0f, 5.0f, 5.0f}, k_up, 0);
  ASSERT_NE(right, nullptr);
  EXPECT_NEAR(right->mean.r, 3.0f, 0.15f);
  const CachedRadiance* below = cache.find({9.0f, 5.0f, 5.0f}, -k_up, 0);
  ASSERT_NE(below, nullptr);
  EXPECT_NEAR(below->mean.b, 8.0f, 1e-4f);
  // Nothing is ever as sure as a few like records say.
  EXPECT_NEAR(below->deviation, 2.0f, 1e-4f);
}

TEST(RadianceCache, SaysNothingWhereItKnowsNothing) {
  const RadianceCache cache(room_of_records(), 2.0f);
  EXPECT_EQ(cache.find({5.0f, 5.0f, 90.0f}, k_up, 0), nullptr);               // no path was there
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, {1.0f, 0.0f, 0.0f}, 0), nullptr);  // on no such side
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, k_up, 1), nullptr);                // no light found
  EXPECT_EQ(cache.find({5.0f, 5.0f, 5.0f}, k_up, 4), nullptr);                // no such world
  EXPECT_EQ(cache.find({1e9f, -1e9f, 1e9f}, k_up, 0), nullptr);
  EXPECT_EQ(RadianceCache({}, 0.0f).find({}, k_up, 0), nullptr);
}

TEST(RadianceCache, OneFarVertexDoesNotStretchTheCells) {
  std::vector<RadianceRecord> records = room_of_records();
  records.push_back({{1e8f, 0.0f, 0.0f}, k_up, 0, Spectrum(1.0f)});
  const RadianceCache cache(records, 2.0f);
  EXPECT_NEAR(cache.find({1.0f, 5.0f, 5.0f}, k_up, 0)->mean.r, 1.0f, 0.05f);
}

TEST(RadianceCache, RecordsInOnePlaceAreOneCell) {
  const std::vector<RadianceRecord> records(100, {{1, 2, 3}, k_up, 2, Spectrum(0.5f)});
  const RadianceCache cache(records, 1.0f);
  ASSERT_NE(cache.find({1, 2, 3}, k_up, 2), nullptr);
  EXPECT_FLOAT_EQ(cache.find({1, 2, 3}, k_up, 2)->mean.g, 0.5f);
}

TEST(PathRecorder, ARecordIsWhatCameAfterOverTheThroughput) {
  PathRecorder recorder;
  recorder.begin();
  const RadianceRecord where{{}, k_up, 0, {}};
  recorder.diffuse_surface(where, Spectrum(0.5f, 0.25f, 0.0f), Spectrum(1.0f));
  recorder.diffuse_surface(where, Spectrum(0.1f), Spectrum(2.0f));
  std::vector<Spectrum> found;
  recorder.finish(Spectrum(3.0f), [&](const RadianceRecord& r) { found.push_back(r.radiance); });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], Spectrum(4.0f, 8.0f, 0.0f));
  EXPECT_FLOAT_EQ(found[1].r, 10.0f);
}

TEST(Roulette, TracesInProportionToWhatARayWouldChange) {
  const float worthwhile = worthwhile_change(Spectrum(0.25f), 1.0f);
  EXPECT_FLOAT_EQ(worthwhile, 0.5f / k_roulette_effort);
  EXPECT_EQ(roulette_probability(2.0f * worthwhile, worthwhile, 0.0f), 1.0f);
  EXPECT_FLOAT_EQ(roulette_probability(0.5f * worthwhile, worthwhile, 0.0f), 0.5f);
  EXPECT_FLOAT_EQ(roulette_probability(0.3f * worthwhile, worthwhile, 0.4f), 0.4f);
  EXPECT_EQ(roulette_probability(0.0f, worthwhile, 0.0f), k_min_probability);
  EXPECT_EQ(roulette_probability(0.0f, 0.0f, 0.0f), 1.0f);
}

}  // namespace
}  // namespace tenniel
