// SPDX-License-Identifier: Apache-2.0
// Files that are none. What Blender writes is read in blender_tests/cases/test_volume_files.py.
#include "image/volume_io.h"

#include <gtest/gtest.h>

#include <string>

#include "testing/temporary_folder.h"

namespace tenniel {
namespace {

TEST(VolumeIo, SaysWhatIsMissing) {
  const VolumeLoadResult result = load_volume("/nowhere/cloud.vdb", "density", {});
  EXPECT_FALSE(result.grid);
  EXPECT_NE(result.error.find("/nowhere/cloud.vdb"), std::string::npos);
}

TEST(VolumeIo, RefusesOtherFiles) {
  const testing::TemporaryFolder folder;
  for (const char* content : {"", "This is no volume.", " BDW"}) {
    const VolumeLoadResult result = load_volume(folder.make("other.vdb", content), "density", {});
    EXPECT_FALSE(result.grid);
    EXPECT_NE(result.error.find("no OpenVDB file"), std::string::npos) << result.error;
  }
}

TEST(VolumeIo, SurvivesAFileThatEndsAfterItsSignature) {
  const testing::TemporaryFolder folder;
  const std::string file = folder.make("short.vdb", std::string(" BDV\0\0\0\0", 8));
  const VolumeLoadResult result = load_volume(file, "density", {});
  EXPECT_FALSE(result.grid);
  EXPECT_FALSE(result.error.empty());
}

}  // namespace
}  // namespace tenniel
