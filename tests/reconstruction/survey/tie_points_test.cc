// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/tie_points.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

class TiePointsFile : public testing::Test {
 protected:
  TiePointsFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    site_.root = std::filesystem::path(testing::TempDir()) / "tie_points" / test->name();
    std::filesystem::remove_all(site_.root);
  }
  SitePaths site_;
};

TEST_F(TiePointsFile, ReturnsEveryDigit) {
  EXPECT_FALSE(ReadTiePoints(site_));
  TiePoints written = ModelOf(MakeSyntheticNetwork(), 20);
  written.not_placed = {"P9"};
  written.remarks = {"one \"remark\""};
  WriteTiePoints(site_, written);
  const auto read = ReadTiePoints(site_);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->points.size(), written.points.size());
  for (size_t i = 0; i < read->points.size(); ++i) {
    EXPECT_EQ(read->points[i].position, written.points[i].position);
    ASSERT_EQ(read->points[i].marks.size(), written.points[i].marks.size());
    for (size_t k = 0; k < read->points[i].marks.size(); ++k) {
      EXPECT_EQ(read->points[i].marks[k].photo, written.points[i].marks[k].photo);
      EXPECT_EQ(read->points[i].marks[k].pixel, written.points[i].marks[k].pixel);
    }
  }
  for (const auto& [photo, pose] : written.cam_from_model) {
    EXPECT_EQ(read->cam_from_model.at(photo).translation, pose.translation);
  }
  EXPECT_EQ(read->sigma_px, 0.5);
  EXPECT_EQ(read->not_placed, written.not_placed);
  EXPECT_EQ(read->remarks, written.remarks);
}

TEST_F(TiePointsFile, RefusesAFileCutShortOrWithoutSense) {
  WriteTiePoints(site_, ModelOf(MakeSyntheticNetwork(), 20));
  const std::string content = ReadWhole(site_.tie_points());
  for (const size_t size : {content.size() / 3, content.size() / 2, content.size() - 3}) {
    WriteWhole(site_.tie_points(), content.substr(0, size));
    EXPECT_THROW(ReadTiePoints(site_), InputError) << size;
  }
  std::string other = content;
  const size_t format = other.find("insitu tie points");
  WriteWhole(site_.tie_points(), other.replace(format, 6, "outsit"));
  EXPECT_THROW(ReadTiePoints(site_), InputError);
}

TEST_F(TiePointsFile, RefusesPlacesThatNoPhotoHas) {
  for (const char* photo : {"-1", "2", "0.7", "1e300", "0"}) {
    WriteWhole(site_.tie_points(),
               R"({"format": "insitu tie points", "version": 1, "sigma_px": 1, "photos": [
  {"name": "a", "rotation_wxyz": [1, 0, 0, 0], "translation": [0, 0, 0]},
  {"name": "b", "rotation_wxyz": [1, 0, 0, 0], "translation": [1, 0, 0]}],
 "not_placed": [], "remarks": [], "points": [
  [1, 2, 3, 0, 10, 20, )" +
                   std::string(photo) + ", 30, 40]]}\n");
    try {
      ReadTiePoints(site_);
      ADD_FAILURE() << photo;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(":5: "), std::string::npos) << error.what();
    }
  }
}

TEST(TiePointName, IsRecognised) {
  EXPECT_EQ(TiePointName(0), "tie_000001");
  for (const size_t index : {0, 999998, 999999, 12345678}) {
    EXPECT_TRUE(IsTiePointName(TiePointName(index))) << index;
  }
  for (const char* name : {"tie_", "tie_12345", "tie_12345a", "tie_point", "Tie_000001", "a1"}) {
    EXPECT_FALSE(IsTiePointName(name)) << name;
  }
}

}  // namespace
}  // namespace insitu
