// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/ies_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/numeric.h"

namespace tenniel {
namespace {

constexpr float k_unit = 0.0706650768394f;  // watts of a candela

// Vertical 0, 90, 180; the numbers are the horizontal angles and the rows of candela.
std::string type_c(const std::string& counts, const std::string& horizontal,
                   const std::string& candela) {
  return "IESNA:LM-63-1995\nTILT=NONE\n1 1000 2.0 3 " + counts +
         " 1 2 0 0 0\n1.0 1.0 100\n0 90 180\n" + horizontal + "\n" + candela + "\n";
}

TEST(IesProfile, MultipliesAndInterpolatesCandela) {
  const IesProfile profile(type_c("1", "0", "10, 20 30"));
  ASSERT_TRUE(profile.is_usable());
  EXPECT_NEAR(profile.intensity({0.0f, 0.0f, -1.0f}), 20.0f * k_unit, 1e-5f);
  EXPECT_NEAR(profile.intensity({3.0f, 0.0f, 0.0f}), 40.0f * k_unit, 1e-5f);
  // Catmull-Rom half way between the first two, the second standing beyond the pole too.
  const float expected = 0.0625f * (-40.0f + 9.0f * 20.0f + 9.0f * 40.0f - 60.0f);
  EXPECT_NEAR(profile.intensity({0.0f, 1.0f, -1.0f}), expected * k_unit, 1e-5f);
  EXPECT_EQ(profile.intensity({0.0f, 0.0f, 1.0f}), 0.0f);
}

TEST(IesProfile, MirrorsAQuarterToTheWhole) {
  const IesProfile profile(type_c("2", "0 90", "10 10 10 30 30 30"));
  ASSERT_TRUE(profile.is_usable());
  const auto level = [&](float x, float y) { return profile.intensity({x, y, -0.5f}) / k_unit; };
  EXPECT_NEAR(level(0.0f, -1.0f), 20.0f, 1e-4f);
  EXPECT_NEAR(level(0.0f, 1.0f), 20.0f, 1e-4f);
  EXPECT_NEAR(level(1.0f, 0.0f), 60.0f, 1e-4f);
  EXPECT_NEAR(level(-1.0f, 0.0f), 60.0f, 1e-4f);
  EXPECT_NEAR(level(0.3f, -0.7f), level(-0.3f, -0.7f), 1e-4f);
}

TEST(IesProfile, SkipsATiltTable) {
  const std::string text = type_c("1", "0", "10 20 30");
  std::string tilted = text;
  tilted.replace(text.find("NONE"), 4, "INCLUDE\n1\n3\n0 45 90\n1.0 0.9 0.8");
  EXPECT_NEAR(IesProfile(tilted).intensity({0.0f, 0.0f, -1.0f}), 20.0f * k_unit, 1e-5f);
}

TEST(IesProfile, DegradesToABrightSpot) {
  const std::string good = type_c("1", "0", "10 20 30");
  for (const std::string& text :
       {std::string(), std::string("nonsense"), good.substr(0, good.size() - 8),
        type_c("1", "45", "10 20 30"), type_c("-5", "0", "10 20 30"),
        type_c("99999999", "0", "1 2 3")}) {
    const IesProfile profile(text);
    EXPECT_FALSE(profile.is_usable());
    EXPECT_EQ(profile.intensity({0.0f, 0.0f, -1.0f}), IesProfile::k_unusable);
  }
}

TEST(IesProfile, NeverGivesWhatIsNoNumber) {
  const IesProfile profile(type_c("3", "0 180 180", "1 2 3 4 5 6 7 8 9"));
  for (float x = -1.0f; x <= 1.0f; x += 0.25f)
    for (float y = -1.0f; y <= 1.0f; y += 0.25f)
      EXPECT_TRUE(std::isfinite(profile.intensity({x, y, -0.2f})));
  EXPECT_TRUE(std::isfinite(profile.intensity({})));
}

}  // namespace
}  // namespace tenniel
