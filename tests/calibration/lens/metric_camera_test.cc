// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/metric_camera.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

MetricCamera Metric(MetricModel model) {
  MetricCamera camera;
  camera.model = model;
  camera.width = 3000;
  camera.height = 2000;
  camera.pixel_mm = {0.008, 0.0081};
  camera.origin_px = {1499.5, 999.5};
  camera.balanced_radius_mm = 9;
  camera.parameters = {24, 0.1, -0.05, 1e-4, -2e-7, 1e-10, 1e-5, -2e-5, 3e-4, -1e-4};
  return camera;
}

class EitherModel : public testing::TestWithParam<MetricModel> {};

TEST_P(EitherModel, ProjectsBackToTheSamePixel) {
  const MetricCamera camera = Metric(GetParam());
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(2999, 0), Eigen::Vector2d(1500, 1900)}) {
    const auto sight = UnprojectMetric(camera, pixel);
    ASSERT_TRUE(sight);
    const auto again = ProjectMetric(camera, 7 * *sight);
    ASSERT_TRUE(again);
    EXPECT_LT((*again - pixel).norm(), 1e-8);
  }
}

TEST_P(EitherModel, WithoutDistortionIsAPinhole) {
  MetricCamera camera = Metric(GetParam());
  camera.parameters = {24, 0.1, -0.05, 0, 0, 0, 0, 0, 0, 0};
  const auto pixel = ProjectMetric(camera, {0.4, -0.3, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 1499.5 + (24 * 0.2 + 0.1) / 0.008, 1e-9);
  EXPECT_NEAR(pixel->y(), 999.5 - (24 * 0.15 - 0.05) / 0.0081, 1e-9);  // mm count up, pixels down
}

TEST_P(EitherModel, FitsMrcalsModel) {
  MetricCamera camera = Metric(GetParam());
  camera.parameters[9] = 0;  // a shear is none of mrcal's
  const auto fit = FitMetricCamera(camera);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_deviation_px, 0.02);
  const auto pixel = ProjectMetric(camera, {0.4, -0.3, 2.0});
  EXPECT_LT((*fit->camera.Project({0.4, -0.3, 2.0}) - *pixel).norm(), 0.02);
}

TEST_P(EitherModel, BehindTheCamera) {
  EXPECT_FALSE(ProjectMetric(Metric(GetParam()), {0.1, 0.1, 0}));
  EXPECT_FALSE(ProjectMetric(Metric(GetParam()), {0.1, 0.1, -1}));
}

INSTANTIATE_TEST_SUITE_P(MetricCamera, EitherModel,
                         testing::Values(MetricModel::kBackwardBrown,
                                         MetricModel::kBalancedRadial));

// x' = x (1 + K1 r^2) of the measured place; the balanced one vanishes at its radius.
TEST(MetricCamera, RadialTermsByHand) {
  MetricCamera brown = Metric(MetricModel::kBackwardBrown);
  brown.parameters = {24, 0, 0, 1e-4, 0, 0, 0, 0, 0, 0};
  const auto sight = UnprojectMetric(brown, {1499.5 + 1000, 999.5});  // 8 mm from the middle
  ASSERT_TRUE(sight);
  EXPECT_NEAR(24 * sight->x() / sight->z(), 8 * (1 + 1e-4 * 64), 1e-12);

  MetricCamera balanced = Metric(MetricModel::kBalancedRadial);
  balanced.parameters = {24, 0, 0, 1e-4, 3e-7, 0, 0, 0, 0, 0};
  const auto pixel = ProjectMetric(balanced, {9, 0, 24});
  EXPECT_NEAR(pixel->x(), 1499.5 + 9 / 0.008, 1e-9);
}

TEST(MetricCamera, FoldedOverIsNowhere) {
  MetricCamera camera = Metric(MetricModel::kBackwardBrown);
  camera.parameters = {24, 0, 0, -1e-2, 0, 0, 0, 0, 0, 0};  // turns over at 5.8 mm
  EXPECT_FALSE(ProjectMetric(camera, {0.5, 0, 1}));
  EXPECT_FALSE(FitMetricCamera(camera));
}

}  // namespace
}  // namespace insitu
