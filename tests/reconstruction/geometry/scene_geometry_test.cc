// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/scene_geometry.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <regex>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

const Vector3d kGrid(2600000, 1200000, 450);

SceneGeometry SmallScene() {
  SceneGeometry scene;
  scene.origin = kGrid;
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  const Camera camera = Camera::Pinhole(1000.1, 1000.2, 319.7, 239.3, 640, 480);
  scene.cameras = {{"P1", camera, {rotation, -(rotation * kGrid)}}, {"P2", camera, {}}};
  Polygon wall;
  wall.name = "wall";
  wall.material = "stone";
  wall.normal = Vector3d(0, 0.6, 0.8);
  wall.photo = 1;
  for (const auto& [x, y] : {std::pair(0.1, 0.0), {4, 0}, {4, 3}, {0, 3}}) {
    wall.vertices.push_back(kGrid + Vector3d(x, 0.8 * y, -0.6 * y));
  }
  Polygon unseen = wall;
  unseen.name = "unseen";
  unseen.photo.reset();
  const Vector3d along(1, 0, 0), up(0, 0.8, -0.6), corner = kGrid + along + up;
  wall.holes = {{corner, corner + up, corner + up + along}};
  wall.covariance = Eigen::MatrixXd::Constant(21, 21, 1e-6 / 3);
  scene.polygons = {wall, unseen};
  scene.sun = {Vector3d(0.6, 0, 0.8), Eigen::Matrix3d::Constant(1e-7 / 3)};
  scene.zenith = {Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
  scene.vertex_sigma = 0.0123456789012345;
  return scene;
}

SitePaths EmptySite(const std::string& name) {
  SitePaths site{std::filesystem::path(testing::TempDir()) / name};
  std::filesystem::remove_all(site.root);
  return site;
}

std::string ErrorOfReading(const SitePaths& site) {
  try {
    ReadSceneGeometry(site);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Replaces the first match of `pattern` in scene.json; the line of the match.
int Spoil(const SitePaths& site, const std::string& pattern, const std::string& replacement) {
  const std::string text = ReadWhole(site.scene());
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern;
  WriteWhole(site.scene(), match.prefix().str() + replacement + match.suffix().str());
  const std::string before = match.prefix();
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

TEST(SceneGeometry, IsReadAsItWasWritten) {
  const SitePaths site = EmptySite("scene_round_trip");
  const SceneGeometry scene = SmallScene();
  WriteSceneGeometry(site, scene);
  const SceneGeometry read = ReadSceneGeometry(site);
  EXPECT_EQ(read.origin, scene.origin);
  EXPECT_EQ(read.vertex_sigma, scene.vertex_sigma);
  EXPECT_EQ(read.sun->unit, scene.sun->unit);
  EXPECT_EQ(read.sun->covariance, scene.sun->covariance);
  EXPECT_EQ(read.zenith.unit, scene.zenith.unit);
  ASSERT_EQ(read.polygons.size(), 2u);
  EXPECT_EQ(read.polygons[0].vertices, scene.polygons[0].vertices);
  EXPECT_EQ(read.polygons[0].holes, scene.polygons[0].holes);
  EXPECT_TRUE(read.polygons[1].holes.empty());
  EXPECT_EQ(read.polygons[0].normal, scene.polygons[0].normal);
  EXPECT_EQ(read.polygons[0].material, "stone");
  EXPECT_EQ(read.polygons[0].photo, 1);
  ASSERT_EQ(read.polygons[0].covariance.size(), 441);
  EXPECT_EQ(read.polygons[0].covariance, scene.polygons[0].covariance);
  EXPECT_EQ(read.polygons[1].covariance.size(), 0);
  EXPECT_EQ(read.polygons[1].photo, std::nullopt);
  ASSERT_EQ(read.cameras.size(), 2u);
  EXPECT_EQ(read.cameras[0].photo, "P1");
  EXPECT_LT((Center(read.cameras[0].cam_from_world) - kGrid).norm(), 1e-8);
}

TEST(SceneGeometry, WithoutSunIsOvercast) {
  const SitePaths site = EmptySite("scene_overcast");
  SceneGeometry scene = SmallScene();
  scene.sun.reset();
  WriteSceneGeometry(site, scene);
  EXPECT_FALSE(ReadSceneGeometry(site).sun);
}

TEST(SceneGeometry, NamesTheLineOfAnUnknownPhoto) {
  const SitePaths site = EmptySite("scene_unknown_photo");
  WriteSceneGeometry(site, SmallScene());
  const int line = Spoil(site, "\"photo\" *: *\"P2\"", "\"photo\": \"P9\"");
  EXPECT_NE(ErrorOfReading(site).find("scene.json:" + std::to_string(line) + ": "),
            std::string::npos)
      << ErrorOfReading(site);
  EXPECT_NE(ErrorOfReading(site).find("P9"), std::string::npos);
}

TEST(SceneGeometry, RefusesACovarianceOfAnotherSize) {
  const SitePaths site = EmptySite("scene_covariance");
  SceneGeometry scene = SmallScene();
  scene.polygons[0].covariance.setZero(9, 9);
  WriteSceneGeometry(site, scene);
  EXPECT_NE(ErrorOfReading(site).find("three rows and columns a vertex"), std::string::npos);
}

TEST(SceneGeometry, RefusesAnotherFormat) {
  const SitePaths site = EmptySite("scene_format");
  WriteSceneGeometry(site, SmallScene());
  const int line = Spoil(site, "insitu scene 1", "insitu scene 7");
  EXPECT_NE(ErrorOfReading(site).find("scene.json:" + std::to_string(line) + ": "),
            std::string::npos)
      << ErrorOfReading(site);
}

TEST(PointOnPolygon, IsWhereTheSightMeetsThePlane) {
  const Camera camera = Camera::Pinhole(1000, 1000, 319.5, 239.5, 640, 480);
  const PosedCamera posed{"P", camera, {}};
  Polygon wall;  // concave, a slanted plane z = 10 + x
  wall.normal = Vector3d(1, 0, -1).normalized();
  for (const auto& [x, y] : {std::pair(-2.0, -2.0), {-2, 2}, {0, 1}, {2, 2}, {2, -2}}) {
    wall.vertices.emplace_back(x, y, 10 + x);
  }
  const Vector3d inside(1, -0.5, 11), notch(0, 1.5, 10), beside(3, 0, 13);
  const auto hit = PointOnPolygon(posed, *camera.Project(inside), wall);
  ASSERT_TRUE(hit);
  EXPECT_LT((*hit - inside).norm(), 1e-9);
  EXPECT_FALSE(PointOnPolygon(posed, *camera.Project(notch), wall));
  EXPECT_FALSE(PointOnPolygon(posed, *camera.Project(beside), wall));
  wall.holes = {{{0.5, -1, 10.5}, {1.5, -1, 11.5}, {1.5, 0, 11.5}, {0.5, 0, 10.5}}};
  EXPECT_FALSE(PointOnPolygon(posed, *camera.Project(inside), wall));
}

}  // namespace
}  // namespace insitu
