// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_mattes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "calibration/files/error.h"
#include "calibration/foreground_matte.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 64;

// Dark to the left of a slanting edge that is two pixels wide, bright to the right.
double ShareAt(int x, int y) { return std::clamp((32 + 0.2 * (y - 32) - x) / 2 + 0.5, 0.0, 1.0); }

class SiteMattes : public testing::Test {
 protected:
  void SetUp() override {
    site_.root = fs::path(testing::TempDir()) / "insitu_calibration" / "mattes";
    fs::remove_all(site_.root);
    fs::create_directories(site_.photos());
    fs::create_directories(site_.survey() / "trimaps");
    Raster photo(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        photo.SetRgb(x, y, Eigen::Vector3d::Constant(0.7 - 0.6 * ShareAt(x, y)));
      }
    }
    WriteExr(site_.photos() / "A.exr", photo);
  }

  void Draw(double left, double band, double right) {
    Raster drawing(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double code = x < 16 ? left : x < 48 ? band : right;
        drawing.SetRgb(x, y, Eigen::Vector3d::Constant(code));
      }
    }
    WritePng(site_.survey() / "trimaps" / "A.png", drawing, Encoding::kSrgb8);
  }

  std::string ErrorOf(const std::vector<std::string>& photos, bool replace = false) {
    try {
      MakeMattes(site_, photos, replace);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  SitePaths site_;
};

TEST_F(SiteMattes, AreWhatRenderReads) {
  Draw(1, 0.2, 0);
  const auto made = MakeMattes(site_, {}, false);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_NEAR(made[0].open, 0.5, 1e-9);
  EXPECT_NEAR(made[0].fraction, 2.0 / 32, 0.03);
  const auto matte = ReadForegroundMatte(site_, "A", kSide, kSide);
  ASSERT_TRUE(matte);
  for (int y = 4; y < kSide - 4; ++y) {
    for (int x = 0; x < kSide; ++x) ASSERT_NEAR(*matte->At(x, y), ShareAt(x, y), 0.05) << x;
  }
}

TEST_F(SiteMattes, AreNotWrittenOver) {
  Draw(1, 0.2, 0);
  MakeMattes(site_, {"A"}, false);
  EXPECT_NE(ErrorOf({}).find("foreground/A.png: is there already"), std::string::npos);
  EXPECT_EQ(ErrorOf({}, true), "");
}

TEST_F(SiteMattes, FaultsAreNamed) {
  EXPECT_NE(ErrorOf({}).find("trimaps: holds no drawing"), std::string::npos);
  EXPECT_NE(ErrorOf({"A"}).find("trimaps/A.png: is not there"), std::string::npos);
  EXPECT_NE(ErrorOf({"B"}).find("no photograph is named B"), std::string::npos);
  Draw(1, 1, 0);
  EXPECT_NE(ErrorOf({}).find("leaves nothing to be found"), std::string::npos);
}

}  // namespace
}  // namespace insitu
