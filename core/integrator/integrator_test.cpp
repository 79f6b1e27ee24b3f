// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "integrator/limits.h"
#include "integrator/mirror.h"

namespace tenniel {
namespace {

BsdfSample event(LobeClass lobe, bool is_delta = false) {
  BsdfSample sample;
  sample.lobe_class = lobe;
  sample.is_delta = is_delta;
  return sample;
}

TEST(Limits, EachKindOfBounceHasItsOwnBudget) {
  RenderSettings limits;
  limits.max_bounces = 3;
  limits.diffuse_bounces = 1;
  PathState state;
  count_bounce(state, event(LobeClass::diffuse), limits);
  EXPECT_FALSE(state.ends_after_transparent);
  EXPECT_EQ(state.info.kind, RayKind::diffuse);
  count_bounce(state, event(LobeClass::glossy, true), limits);
  EXPECT_FALSE(state.ends_after_transparent);
  EXPECT_TRUE(state.info.is_singular);
  EXPECT_TRUE(state.info.is_reflection);
  count_bounce(state, event(LobeClass::diffuse), limits);
  EXPECT_TRUE(state.ends_after_transparent);
  EXPECT_EQ(state.info.ray_depth, 3);
  EXPECT_EQ(state.info.diffuse_depth, 2);
}

TEST(Limits, ScatteringInMediaHasItsOwnBudget) {
  RenderSettings limits;
  limits.max_bounces = 8;
  limits.volume_bounces = 1;
  PathState state;
  state.info.is_diffuse = true;
  count_volume_bounce(state, limits);
  EXPECT_FALSE(state.ends_after_transparent);
  EXPECT_EQ(state.info.kind, RayKind::volume_scatter);
  EXPECT_FALSE(state.info.is_diffuse);
  EXPECT_FALSE(state.sees_background);
  count_volume_bounce(state, limits);
  EXPECT_TRUE(state.ends_after_transparent);
  EXPECT_EQ(state.info.volume_depth, 2);
  EXPECT_EQ(state.info.ray_depth, 2);
}

TEST(MediumStack, EntriesComeAndGoInAnyOrder) {
  MediumStack media;
  media.enter({1, 0});
  media.enter({2, 0});
  media.enter({1, 1});
  media.enter({2, 0});  // already there
  EXPECT_EQ(media.end() - media.begin(), 3);
  media.leave({1, 0});
  EXPECT_FALSE(media.contains({1, 0}));
  EXPECT_TRUE(media.contains({2, 0}));
  EXPECT_TRUE(media.contains({1, 1}));
  media.leave({7, 0});  // never entered
  media.leave({2, 0});
  media.leave({1, 1});
  EXPECT_TRUE(media.empty());
  for (uint32_t i = 0; i < 100; ++i)
    media.enter({i, 0});
  EXPECT_EQ(static_cast<size_t>(media.end() - media.begin()), MediumStack::k_max_media);
}

TEST(Limits, ClampBoundsTheSumOfChannelsAtThreeTimesTheLimit) {
  RenderSettings limits;
  limits.clamp_direct = 0.0f;
  limits.clamp_indirect = 1.0f;
  const Spectrum bright(9.0f, 6.0f, 3.0f);
  EXPECT_EQ(clamped(bright, 0, limits), bright);
  const Spectrum cut = clamped(bright, 1, limits);
  EXPECT_NEAR(cut.r + cut.g + cut.b, 3.0f, 1e-6f);
  EXPECT_NEAR(cut.r / cut.b, 3.0f, 1e-5f);
}

TEST(Limits, RouletteSparesTheFirstBounces) {
  RenderSettings limits;
  limits.min_light_bounces = 2;
  PathState state;
  state.throughput = Spectrum(0.25f, 0.01f, 0.0f);
  state.info.ray_depth = 3;
  EXPECT_EQ(survival_probability(state, limits), 1.0f);
  state.info.ray_depth = 4;
  EXPECT_FLOAT_EQ(survival_probability(state, limits), 0.5f);
  state.throughput = Spectrum(0.5f);
  EXPECT_EQ(survival_probability(state, limits), 1.0f);
}

TEST(Mirror, GroupsPartTheLobesByEntry) {
  PathState state;
  LookingGlass glass{2, MirrorEntry::reflection, MirrorReentry::stay, false};
  WorldGroups groups = world_groups(glass, state);
  EXPECT_EQ(groups.of(LobeClass::glossy).world, 2);
  EXPECT_EQ(groups.of(LobeClass::diffuse).world, 0);
  EXPECT_EQ(groups.of(LobeClass::transmission).world, 0);
  EXPECT_EQ(groups.of(LobeClass::transparent).world, 0);
  EXPECT_EQ(groups.keeping.lobes.bits & groups.entering.lobes.bits, 0);
  EXPECT_EQ(groups.keeping.lobes.bits | groups.entering.lobes.bits, LobeSet::all().bits);

  glass.entry = MirrorEntry::transmission;
  groups = world_groups(glass, state);
  EXPECT_EQ(groups.of(LobeClass::glossy).world, 0);
  EXPECT_EQ(groups.of(LobeClass::transparent).world, 2);
  EXPECT_EQ(groups.of(LobeClass::transmission).world, 2);
}

TEST(Mirror, ToggleComesBackStayDoesNot) {
  LookingGlass glass{1, MirrorEntry::reflection, MirrorReentry::stay, false};
  EXPECT_EQ(world_after_entering(glass, 0), 1);
  EXPECT_EQ(world_after_entering(glass, 1), 1);
  EXPECT_EQ(world_after_entering(glass, 3), 1);
  glass.reentry = MirrorReentry::toggle;
  EXPECT_EQ(world_after_entering(glass, 0), 1);
  EXPECT_EQ(world_after_entering(glass, 1), 0);
  EXPECT_EQ(world_after_entering(glass, 3), 1);
}

TEST(Mirror, FirstSeenOnlyClosesAfterARoughBounce) {
  RenderSettings limits;
  PathState state;
  const LookingGlass glass{1, MirrorEntry::reflection, MirrorReentry::stay, true};
  count_bounce(state, event(LobeClass::glossy, true), limits);
  EXPECT_FALSE(entering_lobes(glass, state).empty());
  count_bounce(state, event(LobeClass::diffuse), limits);
  EXPECT_TRUE(entering_lobes(glass, state).empty());
}

}  // namespace
}  // namespace tenniel
