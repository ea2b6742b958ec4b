// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap_export.h"

#include <gtest/gtest.h>

#include "calibration/lens/lens_residual.h"
#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/colmap/colmap_text.h"
#include "reconstruction/colmap/read_colmap_model.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

// DBAT's camera of the Arch of Constantine, backward Brown, in mm.
MetricCamera RomaCamera() {
  MetricCamera camera;
  camera.width = 5616;
  camera.height = 3744;
  camera.pixel_mm = {36.0 / 5616, 24.0 / 3744};
  camera.origin_px = {-0.5, -0.5};
  camera.parameters = {24.5425, 18.0816, -12.0165, 2.21523e-4, -1.86985e-7, 0, 0, 0, 0, 0};
  return camera;
}

TEST(FitColmapLens, TakesKnownLensesExactly) {
  const Camera camera("LENSMODEL_OPENCV4", {1500, 1501, 890, 610, -0.1, 0.02, 1e-4, 0}, 1800, 1200);
  const ColmapLensFit fit = FitColmapLens(camera);
  EXPECT_EQ(fit.largest_px, 0);
  EXPECT_EQ(fit.lens, *ColmapFromCamera(camera));
}

TEST(FitColmapLens, ComesNearAMetricCamera) {
  const MetricCamera metric = RomaCamera();
  const ColmapLensFit fit = FitColmapLens(metric);
  EXPECT_LT(fit.largest_px, 0.01);
  EXPECT_EQ(fit.lens.width, 5616);
  const auto camera = CameraFromColmap(fit.lens);
  ASSERT_TRUE(camera);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(100, 200), Eigen::Vector2d(5000, 3300)}) {
    Eigen::Vector2d residual;
    ASSERT_TRUE(LensResidual(metric, metric.parameters.data(), camera->Unproject(pixel), pixel,
                             &residual, {}));
    EXPECT_LT(residual.norm(), 0.02);
  }
}

TEST(FitColmapLens, ComesNearAThinPrism) {
  const std::vector<double> intrinsics = {1500, 1505, 890, 610, -0.15, 0.04, 1e-3, -2e-3,
                                          0.01, 0,    0,   0,   1e-5,  2e-5, 0,    0};
  const Camera camera("LENSMODEL_OPENCV12", intrinsics, 1800, 1200);
  EXPECT_LT(FitColmapLens(camera).largest_px, 0.05);
}

// Every keypoint of the model is where its image says the point is, half a pixel from ours.
void ExpectConsistent(const ColmapModel& model, double tolerance_px) {
  size_t elements = 0;
  for (const auto& [id, point] : model.points) {
    ASSERT_GE(point.track.size(), 2u);
    EXPECT_LT(point.error_px, tolerance_px);
    for (const ColmapTrackElement& element : point.track) {
      const ColmapImage& image = model.images.at(element.image);
      const auto camera = CameraFromColmap(model.cameras.at(image.camera));
      const auto pixel = camera->Project(image.cam_from_world * point.position);
      ASSERT_TRUE(pixel);
      const Eigen::Vector2d keypoint = image.keypoints.at(element.keypoint).position;
      EXPECT_LT((ColmapFromPixel(*pixel) - keypoint).norm(), tolerance_px);
      ++elements;
    }
  }
  EXPECT_GT(elements, 100u);
}

TEST(ColmapFromAdjustment, IsTheResultInCOLMAPsTerms) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const ColmapModel model =
      ColmapFromAdjustment(Adjust(network.survey, network.photos, network.cameras));
  EXPECT_EQ(model.cameras.size(), 1u);
  EXPECT_EQ(model.images.size(), 4u);
  ExpectConsistent(model, 1e-3);
  const auto folder = std::filesystem::path(testing::TempDir()) / "colmap_export";
  WriteColmapText(folder, model);
  ExpectConsistent(ReadColmapModel(folder), 1e-3);  // its references hold too
}

}  // namespace
}  // namespace insitu
