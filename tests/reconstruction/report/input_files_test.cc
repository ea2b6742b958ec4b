// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/input_files.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/report/montage_points.h"

namespace insitu {
namespace {

class InputFiles : public testing::Test {
 protected:
  InputFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    site_.root = std::filesystem::path(testing::TempDir()) / "input_files" / test->name();
    std::filesystem::remove_all(site_.root);
  }
  SitePaths site_;
};

TEST_F(InputFiles, AreNamedBelowTheSiteFolder) {
  WriteWhole(site_.photos() / "left.jpg", "1");
  WriteWhole(site_.survey() / "observations.csv", "2");
  WriteWhole(site_.survey() / ".observations.csv.swp", "3");
  WriteWhole(site_.camera("wide"), "4");
  WriteWhole(site_.camera("tele"), "5");
  WriteWhole(site_.calibration_report("wide"), "6");
  WriteWhole(site_.tie_points(), "7");
  std::vector<std::string> names;
  for (const InputFile& input : HashInputs(site_, {"wide", "tele", "wide"})) {
    names.push_back(input.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"photos/left.jpg", "survey/observations.csv",
                                             "work/calibration/tele/camera.cameramodel",
                                             "work/calibration/wide/camera.cameramodel",
                                             "work/calibration/wide/report.json",
                                             "work/tie_points/tie_points.json"}));
}

TEST_F(InputFiles, TellWhereTheLensIsValid) {
  WriteWhole(site_.camera(),
             "{ 'lensmodel': 'LENSMODEL_PINHOLE',\n 'valid_intrinsics_region': [\n    [ 1, 1 ],\n"
             "    [ 90.5, 2 ],\n    [ 80, 7e1 ],\n],\n 'imagersize': [ 100, 80,],\n}\n");
  const auto outline = ReadCalibratedRegion(site_.camera());
  ASSERT_EQ(outline.size(), 3u);
  EXPECT_EQ(outline[1], Eigen::Vector2d(90.5, 2));
  EXPECT_EQ(outline[2], Eigen::Vector2d(80, 70));
  for (const char* none : {"{ 'imagersize': [ 100, 80,],\n}\n", "'valid_intrinsics_region': [",
                           "'valid_intrinsics_region': []"}) {
    WriteWhole(site_.camera(), none);
    EXPECT_TRUE(ReadCalibratedRegion(site_.camera()).empty()) << none;
  }
}

TEST_F(InputFiles, NameTheMontagesPoints) {
  WriteWhole(site_.root / "site.json",
             R"({"report_points": [{"name": "ridge", "position": [1, 2, 3]}]})");
  const auto points = MontagePoints(site_, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].name, "ridge");
  EXPECT_EQ(points[0].position, Eigen::Vector3d(1, 2, 3));
  WriteWhole(site_.root / "site.json", "{\n\"report_points\": [{\"name\": \"ridge\"}]}");
  EXPECT_THROW(MontagePoints(site_, {}), InputError);
}

TEST_F(InputFiles, LeaveTheMontageTheBoxOfTheWalls) {
  SceneGeometry scene;
  scene.zenith.unit = Eigen::Vector3d::UnitZ();
  Polygon lawn, wall;
  lawn.normal = Eigen::Vector3d::UnitZ();
  lawn.vertices = {{-100, -100, 0}, {100, -100, 0}, {0, 100, 0}};
  wall.normal = Eigen::Vector3d::UnitY();
  wall.vertices = {{0, 5, 0}, {4, 5, 0}, {4, 5, 3}, {0, 5, 3}};
  scene.polygons = {lawn, wall};
  const auto points = MontagePoints(site_, scene);
  ASSERT_EQ(points.size(), 8u);
  for (const MontagePoint& point : points) {
    EXPECT_EQ(point.position.y(), 5);
    EXPECT_EQ(point.position.z(), point.name.find("top") == std::string::npos ? 0 : 3);
    EXPECT_EQ(point.position.x(), point.name.find("max x") == std::string::npos ? 0 : 4);
  }
}

}  // namespace
}  // namespace insitu
