// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/demo_site.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <map>
#include <string>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"

namespace insitu::demo {
namespace {

namespace fs = std::filesystem;

SiteOptions Small() {
  SiteOptions options;
  options.width = 192;
  options.height = 128;
  options.strata = 3;
  return options;
}

// One small site for all tests; others are made beside it.
class DemoSite : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SiteOptions options = Small();
    options.step_done = [] { ++steps_; };
    summary_ = MakeDemoSite(Root() / "site", options);
  }
  static void TearDownTestSuite() { fs::remove_all(Root()); }

  static fs::path Root() {
    return fs::path(testing::TempDir()) / ("insitu_demo_site_" + std::to_string(getpid()));
  }

  const fs::path site_ = Root() / "site";
  static inline SiteSummary summary_;
  static inline int steps_ = 0;
};

std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    contents[fs::relative(entry.path(), folder).string()] = ReadWhole(entry.path());
  }
  return contents;
}

TEST_F(DemoSite, IsTheSameBytesForAnyNumberOfThreads) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  MakeDemoSite(Root() / "again", Small());
  const auto first = Contents(site_), second = Contents(Root() / "again");
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(second.count(name)) << name;
    EXPECT_TRUE(bytes == second.at(name)) << name << " differs";
  }
}

TEST_F(DemoSite, HasEveryFileOfASiteFolder) {
  EXPECT_EQ(steps_, kDemoSiteSteps);
  EXPECT_EQ(summary_.photos, 3);
  EXPECT_EQ(summary_.board_photos, 16);
  for (const char* name :
       {"site.json", "photos/left.jpg", "calibration/board.txt", "calibration/board_16.jpg",
        "survey/control_points.csv", "survey/observations.csv", "survey/polygons.json",
        "survey/directions.json", "survey/samples.json", "survey/materials.json",
        "building/building.dxf", "building/materials.json", "truth/truth.json",
        "truth/before_left.exr", "truth/after_middle.exr", "truth/mask_right.png"}) {
    EXPECT_TRUE(fs::exists(site_ / name)) << name;
  }
}

// Within a tenth of an 8-bit code.
bool IsSame(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  for (int i = 0; i < 3; ++i) {
    const double change = SrgbFromLinear(before[i]) - SrgbFromLinear(after[i]);
    if (std::abs(change) > 0.1 / 255 + 1e-6) return false;
  }
  return true;
}

// The montage's first law, seen from the truth: away from the mask nothing changes that shows.
TEST_F(DemoSite, ChangesOnlyWhatTheMaskMarks) {
  const Raster before = ReadPhotograph(site_ / "truth/before_right.exr").linear;
  const Raster after = ReadPhotograph(site_ / "truth/after_right.exr").linear;
  const Raster mask = ReadPhotograph(site_ / "truth/mask_right.png").linear;
  int untouched = 0, building = 0, unmarked_changes = 0;
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      const bool marked = *mask.At(x, y) > 0;
      unmarked_changes += !marked && !IsSame(before.Rgb(x, y), after.Rgb(x, y));
      untouched += *mask.At(x, y) == 0;
      building += *mask.At(x, y) == 1;
    }
  }
  EXPECT_EQ(unmarked_changes, 0);
  EXPECT_GT(untouched, 5000);
  EXPECT_GT(building, 500);
}

TEST_F(DemoSite, ChoosesSamplesOfTheRightColor) {
  SiteOptions options;
  options.width = 720;  // smaller pictures have no room for 9 x 9 pure pixels on a support
  options.height = 480;
  options.strata = 3;
  options.with_boards = false;
  const fs::path large = Root() / "large";
  const SiteSummary summary = MakeDemoSite(large, options);
  EXPECT_EQ(summary.horizon_samples, 3);
  EXPECT_GE(summary.haze_samples, 10);
  EXPECT_GE(summary.daylight_samples, 12);
  const JsonNode samples = JsonNode::Load(large / "survey/samples.json");
  for (const JsonNode& sample : samples.At("horizon").Items()) {
    const Raster photo =
        ReadPhotograph(large / "photos" / (sample.At("photo").Text() + ".jpg")).linear;
    const Eigen::Vector3d rgb = photo.Rgb(sample.At("x").Integer(), sample.At("y").Integer());
    EXPECT_GT(rgb.z(), rgb.x());  // the sky is blue
  }
  for (const JsonNode& sample : samples.At("haze").Items()) {
    EXPECT_EQ(sample.At("polygon").Text(), "lawn");
  }
}

}  // namespace
}  // namespace insitu::demo
