// SPDX-License-Identifier: Apache-2.0
// Files that are none. What Blender writes is read in blender_tests/cases/test_volume_files.py.
#include "image/volume_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tenniel {
namespace {

// A file below the folder for temporary ones, gone with the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() / "tenniel_volume_io_test.vdb") {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

TEST(VolumeIo, SaysWhatIsMissing) {
  const VolumeLoadResult result = load_volume("/nowhere/cloud.vdb", "density", {});
  EXPECT_FALSE(result.grid);
  EXPECT_NE(result.error.find("/nowhere/cloud.vdb"), std::string::npos);
}

TEST(VolumeIo, RefusesOtherFiles) {
  for (const char* content : {"", "This is no volume.", " BDW"}) {
    const TemporaryFile file(content);
    const VolumeLoadResult result = load_volume(file.path(), "density", {});
    EXPECT_FALSE(result.grid);
    EXPECT_NE(result.error.find("no OpenVDB file"), std::string::npos) << result.error;
  }
}

TEST(VolumeIo, SurvivesAFileThatEndsAfterItsSignature) {
  const TemporaryFile file(std::string(" BDV\0\0\0\0", 8));
  const VolumeLoadResult result = load_volume(file.path(), "density", {});
  EXPECT_FALSE(result.grid);
  EXPECT_FALSE(result.error.empty());
}

}  // namespace
}  // namespace tenniel
