// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_uncertainty.h"

#include <gtest/gtest.h>

#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// One camera at the origin of a national grid's place, looking along z, known to a centimetre in x.
SceneGeometry OneCamera() {
  SceneGeometry scene;
  scene.origin = {2600000, 1200000, 400};
  const Rigid3 cam_from_world{Eigen::Quaterniond::Identity(), -scene.origin};
  scene.cameras = {{"photo", Camera::Pinhole(1000, 1000, 500, 400, 1001, 801), cam_from_world}};
  scene.camera_covariances = {Eigen::MatrixXd::Zero(6, 6)};
  scene.camera_covariances[0](3, 3) = 0.01 * 0.01;
  return scene;
}

// Corners 20 m and 10 m away, one of them drawn twice, and one behind the camera.
std::vector<Eigen::Vector3d> Corners(const Eigen::Vector3d& origin) {
  std::vector<Eigen::Vector3d> corners;
  for (const double depth : {20.0, 10.0, 10.0001, -10.0}) {
    corners.push_back(origin + Eigen::Vector3d(0, 0, depth));
  }
  return corners;
}

TEST(BuildingUncertainty, IsOfEveryCornerInTheFrameOnce) {
  const SceneGeometry scene = OneCamera();
  const auto corners = BuildingUncertainty(scene, 0, Corners(scene.origin));
  ASSERT_TRUE(corners);
  ASSERT_EQ(corners->size(), 2u);
  EXPECT_NEAR(corners->at(0).image.major_px, 1000 * 0.01 / 20, 1e-9);
  const UncertaintySummary summary = Summarize(*corners);
  EXPECT_EQ(summary.corners, 2);
  EXPECT_NEAR(summary.worst_px, 1, 1e-9);
  EXPECT_NEAR(summary.worst_m, 0.01, 1e-9);
  EXPECT_THROW(Summarize({}), CheckError);
}

TEST(BuildingUncertainty, IsUnknownWithoutCovariances) {
  SceneGeometry scene = OneCamera();
  scene.camera_covariances.clear();
  EXPECT_FALSE(BuildingUncertainty(scene, 0, Corners(scene.origin)));
}

TEST(ThinnedOut, KeepsTheLeastKnownOfWhatIsClose) {
  std::vector<CornerUncertainty> corners(30000);
  for (size_t i = 0; i < corners.size(); ++i) {
    const size_t column = i % 150, row = i / 150;
    corners[i].image.pixel = {static_cast<double>(column), static_cast<double>(row)};
    corners[i].image.major_px = i == 20250 ? 2 : 1;
  }
  const std::vector<CornerUncertainty> kept = ThinnedOut(corners);
  EXPECT_LE(kept.size(), 10000u);
  EXPECT_GT(kept.size(), 5000u);
  EXPECT_EQ(Summarize(kept).worst_px, 2);
  corners.resize(10000);
  EXPECT_EQ(ThinnedOut(corners).size(), 10000u);
}

TEST(WriteUncertainty, ALineACorner) {
  const ScratchFolder folder;
  const SceneGeometry scene = OneCamera();
  WriteUncertainty(folder.path() / "u.csv", *BuildingUncertainty(scene, 0, Corners(scene.origin)));
  EXPECT_EQ(ReadWhole(folder.path() / "u.csv"),
            "x,y,z,pixel_x,pixel_y,sigma_major_px,sigma_minor_px,sigma_mm\n"
            "2600000.0000,1200000.0000,420.0000,500.00,400.00,0.5000,0.0000,10.000\n"
            "2600000.0000,1200000.0000,410.0000,500.00,400.00,1.0000,0.0000,10.000\n");
}

}  // namespace
}  // namespace insitu
