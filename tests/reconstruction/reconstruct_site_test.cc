// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/reconstruct_site.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

class Site : public testing::Test {
 protected:
  Site() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    site_.root = std::filesystem::path(testing::TempDir()) / "reconstruct_site" / test->name();
    std::filesystem::remove_all(site_.root);
    WriteSurvey(site_, WithNoise(network_.survey, 1));
    WritePosedCamera(site_.camera(), {"camera", network_.cameras[0], {}}, "lens of the test");
    for (const std::string& photo : network_.photos) {
      WritePhoto(photo, network_.cameras[0].width());
    }
  }
  // Only names and sizes count here; but no two photographs may be alike.
  void WritePhoto(const std::string& name, int width) {
    Raster photo(width, network_.cameras[0].height());
    photo.SetRgb(name.back() - '0', 0, {1, 1, 1});
    WritePng(site_.photos() / (name + ".png"), photo, Encoding::kSrgb8);
  }

  SyntheticNetwork network_ = MakeSyntheticNetwork();
  SitePaths site_;
};

TEST_F(Site, GetsItsSceneCamerasAndReports) {
  const Adjustment adjustment = ReconstructSite(site_);
  const SceneGeometry scene = ReadSceneGeometry(site_);
  ASSERT_EQ(scene.polygons.size(), adjustment.scene.polygons.size());
  for (size_t i = 0; i < scene.polygons.size(); ++i) {
    EXPECT_EQ(scene.polygons[i].vertices, adjustment.scene.polygons[i].vertices);
  }
  ASSERT_EQ(scene.cameras.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT((Center(scene.cameras[i].cam_from_world) - Center(network_.cam_from_world[i])).norm(),
              0.05);
  }
  EXPECT_TRUE(std::filesystem::exists(site_.residual_report()));
  EXPECT_TRUE(std::filesystem::exists(site_.residual_page()));
}

TEST_F(Site, GivesTheSameBytesTwice) {
  ReconstructSite(site_);
  const auto files = {site_.scene(), site_.posed_camera("P1"), site_.residual_report(),
                      site_.residual_page()};
  std::string first, second;
  for (const auto& file : files) first += ReadWhole(file);
  std::filesystem::remove_all(site_.scene().parent_path());
  ReconstructSite(site_);
  for (const auto& file : files) second += ReadWhole(file);
  EXPECT_EQ(first, second);
}

TEST_F(Site, WritesNothingOnBadInput) {
  const auto marks = site_.survey() / "observations.csv";
  WriteWhole(marks, ReadWhole(marks) + "P9,A,1,1,0.4\n");
  EXPECT_THROW(ReconstructSite(site_), InputError);
  EXPECT_FALSE(std::filesystem::exists(site_.scene().parent_path()));
}

TEST_F(Site, TakesEstimates) {
  const auto estimates = site_.root / "start.json";
  WriteWhole(estimates, R"({"P1": {"center": [986, 1976, 402], "look_at": [1000, 2004, 403]}})");
  const auto poses = ReadStartPoses(estimates, network_.photos);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_LT((Center(poses.at("P1")) - Eigen::Vector3d(986, 1976, 402)).norm(), 1e-9);
  // The point looked at lies on the axis, and up is up: -y in the picture.
  const Eigen::Vector3d target = poses.at("P1") * Eigen::Vector3d(1000, 2004, 403);
  EXPECT_LT(target.head<2>().norm(), 1e-9);
  EXPECT_GT(target.z(), 0);
  EXPECT_LT((poses.at("P1").rotation * Eigen::Vector3d::UnitZ()).y(), -0.99);
  EXPECT_NO_THROW(ReconstructSite(site_, {}, estimates));
  EXPECT_NE(ReadWhole(site_.residual_report()).find("--start start.json"), std::string::npos);
}

// The only camera of a site has no name; one that is called camera is another matter.
TEST_F(Site, TakesAFolderNamedCamera) {
  for (const auto& model : {site_.boards() / "camera/camera.cameramodel", site_.camera("camera")}) {
    WritePosedCamera(model, {"camera", network_.cameras[0], {}}, "lens of the test");
  }
  std::filesystem::remove(site_.camera());
  EXPECT_NO_THROW(ReconstructSite(site_));
  EXPECT_EQ(
      JsonNode::Load(site_.residual_report()).At("cameras").Items()[0].At("model_file").Text(),
      "work/calibration/camera/camera.cameramodel");
}

TEST_F(Site, RefusesAPhotoOfAnotherSize) {
  WritePhoto("P2", network_.cameras[0].width() / 2);
  try {
    ReconstructSite(site_);
    ADD_FAILURE() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("P2.png: is "), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(site_.scene().parent_path()));
}

TEST_F(Site, RefusesAnEstimateOfAnUnknownPhoto) {
  const auto estimates = site_.root / "start.json";
  WriteWhole(estimates, "{\n\"P8\": {\"center\": [0, 0, 0], \"look_at\": [0, 9, 0]}}");
  try {
    ReadStartPoses(estimates, network_.photos);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("start.json:2: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("P8"), std::string::npos);
  }
}

}  // namespace
}  // namespace insitu
