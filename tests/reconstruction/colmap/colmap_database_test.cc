// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_database.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <Eigen/Geometry>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

ColmapDatabase SmallDatabase() {
  ColmapDatabase database;
  database.cameras[2] = {"PINHOLE", 64, 48, {50, 51, 32, 24}};
  database.images[3] = {"a b.jpg", 2, Eigen::Vector3d(1, 2, 3)};
  database.images[8] = {"c.jpg", 2};
  database.features[3] = ColmapFeatures::Random(4, 6);
  database.features[8] = ColmapFeatures::Random(3, 4);
  database.matches[{3, 8}] = {{0, 2}, {3, 1}};
  ColmapTwoViewGeometry& geometry = database.two_view_geometries[{3, 8}];
  geometry.config = 2;
  geometry.inliers = {{3, 1}};
  geometry.fundamental = Eigen::Matrix3d::Random();
  geometry.second_from_first =
      Rigid3{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())), {1, 0, 0}};
  return database;
}

class DatabaseFile : public testing::Test {
 protected:
  DatabaseFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(testing::TempDir()) / "colmap_database" / test->name() / "database.db";
    fs::remove_all(path_.parent_path());
    WriteColmapDatabase(path_, SmallDatabase());
  }

  void Execute(const std::string& sql) const {
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(handle);
    sqlite3_close(handle);
  }

  std::string Fault() const {
    try {
      ReadColmapDatabase(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  fs::path path_;
};

// pair_id = 2147483647 min + max, as COLMAP has it.
TEST(ColmapPairId, IsThatOfCOLMAP) {
  EXPECT_EQ(ColmapPairId({1, 2}), 2147483649u);
  EXPECT_EQ(ColmapPairId({2147483645, 2147483646}), 2147483647ull * 2147483645 + 2147483646);
}

TEST_F(DatabaseFile, ReturnsWhatWasWritten) {
  const ColmapDatabase read = ReadColmapDatabase(path_), truth = SmallDatabase();
  EXPECT_EQ(read.cameras, truth.cameras);
  ASSERT_EQ(read.images.size(), 2u);
  EXPECT_EQ(read.images.at(3).name, "a b.jpg");
  EXPECT_EQ(read.images.at(3).prior_center, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(read.images.at(8).prior_center);
  EXPECT_EQ(read.features.at(3).rows(), 4);
  EXPECT_EQ(read.features.at(8).cols(), 4);
  EXPECT_EQ(read.matches, truth.matches);
  const ColmapTwoViewGeometry& geometry = read.two_view_geometries.at({3, 8});
  EXPECT_EQ(geometry.config, 2);
  EXPECT_EQ(geometry.inliers, (ColmapMatches{{3, 1}}));
  EXPECT_TRUE(geometry.fundamental.has_value());
  EXPECT_FALSE(geometry.homography.has_value());
  EXPECT_EQ(geometry.second_from_first->translation, Eigen::Vector3d(1, 0, 0));
}

TEST_F(DatabaseFile, GivesTheSameBytesTwice) {
  ColmapDatabase database;
  database.cameras[1] = {"PINHOLE", 64, 48, {50, 51, 32, 24}};
  database.images[1] = {"a.jpg", 1};
  WriteColmapDatabase(path_, database);
  const std::string first = ReadWhole(path_);
  WriteColmapDatabase(path_, database);
  EXPECT_EQ(ReadWhole(path_), first);
}

TEST_F(DatabaseFile, UpdatesKeypointsAndCamerasAlone) {
  const ColmapFeatures moved = ColmapFeatures::Constant(4, 6, 7);
  UpdateColmapDatabase(path_, {{2, {"PINHOLE", 70, 50, {50, 50, 35, 25}}}}, {{3, moved}});
  const ColmapDatabase read = ReadColmapDatabase(path_);
  EXPECT_EQ(read.features.at(3), moved);
  EXPECT_EQ(read.features.at(8).rows(), 3);
  EXPECT_EQ(read.cameras.at(2).width, 70);
  EXPECT_EQ(read.matches.size(), 1u);
}

TEST_F(DatabaseFile, ReadsTheTablesOfCOLMAP4) {
  Execute(
      "CREATE TABLE new (image_id INTEGER PRIMARY KEY, name TEXT, camera_id INTEGER);"
      "INSERT INTO new SELECT image_id, name, camera_id FROM images;"
      "DROP TABLE images; ALTER TABLE new RENAME TO images;"
      "CREATE TABLE rigs (rig_id INTEGER); CREATE TABLE frames (frame_id INTEGER);");
  const ColmapDatabase read = ReadColmapDatabase(path_);
  EXPECT_EQ(read.images.at(8).name, "c.jpg");
  EXPECT_FALSE(read.images.at(3).prior_center);
}

TEST_F(DatabaseFile, NamesTableAndRowOfEachFault) {
  Execute("UPDATE matches SET data = X'0000000009000000', rows = 1");
  EXPECT_NE(Fault().find("table matches, row 1: a match of a keypoint that image 8"),
            std::string::npos);
  Execute("DELETE FROM matches; UPDATE keypoints SET rows = 5 WHERE image_id = 8");
  EXPECT_NE(Fault().find("table keypoints, row 2: 48 bytes"), std::string::npos) << Fault();
  Execute("UPDATE images SET camera_id = 5 WHERE image_id = 3");
  EXPECT_NE(Fault().find("table images, row 1: image 'a b.jpg' has camera 5"), std::string::npos);
  Execute("UPDATE cameras SET model = 77");
  EXPECT_NE(Fault().find("table cameras, row 1: lens model 77"), std::string::npos);
  Execute("DROP TABLE cameras");
  EXPECT_NE(Fault().find("table cameras cannot be read"), std::string::npos);
}

TEST_F(DatabaseFile, NamesAFileThatIsCutShortOrNone) {
  const std::string content = ReadWhole(path_);
  WriteWhole(path_, content.substr(0, content.size() / 2));
  EXPECT_NE(Fault(), "none");
  WriteWhole(path_, "this is no database, whatever its name says, not at all, never was one");
  EXPECT_NE(Fault().find("cannot be read"), std::string::npos) << Fault();
  fs::remove(path_);
  EXPECT_NE(Fault().find("cannot be opened"), std::string::npos);
}

}  // namespace
}  // namespace insitu
