// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/lens_residual.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

const Eigen::Vector3d kPoint(0.4, -0.3, 2.0);
const Eigen::Vector2d kObserved(1900, 1000);

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

Eigen::Vector2d ResidualOf(const Lens& lens, const std::vector<double>& parameters,
                           const Eigen::Vector3d& point) {
  Eigen::Vector2d residual;
  EXPECT_TRUE(LensResidual(lens, parameters.data(), point, kObserved, &residual, {}));
  return residual;
}

// Both derivatives against central differences.
void ExpectDerivatives(const Lens& lens) {
  const std::vector<double> parameters = LensParameters(lens);
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_parameters;
  Eigen::Vector2d residual;
  ASSERT_TRUE(LensResidual(lens, parameters.data(), kPoint, kObserved, &residual,
                           {&by_point, &by_parameters}));
  EXPECT_LT((residual - ResidualOf(lens, parameters, kPoint)).norm(), 1e-9);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d difference = (ResidualOf(lens, parameters, kPoint + step) -
                                        ResidualOf(lens, parameters, kPoint - step)) /
                                       2e-6;
    EXPECT_LT((difference - by_point.col(i)).norm(), 1e-5 * by_point.norm());
  }
  for (size_t i = 0; i < parameters.size(); ++i) {
    const double step = 1e-6 * std::max(std::abs(parameters[i]), 1e-6);
    std::vector<double> more = parameters, less = parameters;
    more[i] += step;
    less[i] -= step;
    const Eigen::Vector2d difference =
        (ResidualOf(lens, more, kPoint) - ResidualOf(lens, less, kPoint)) / (2 * step);
    const Eigen::Vector2d derivative = by_parameters.col(static_cast<Eigen::Index>(i));
    EXPECT_LT((difference - derivative).norm(), 1e-4 * derivative.norm() + 1e-3) << i;
  }
}

TEST(LensResidual, HasTheDerivativesOfDifferences) {
  ExpectDerivatives(Metric(MetricModel::kBackwardBrown));
  ExpectDerivatives(Metric(MetricModel::kBalancedRadial));
  ExpectDerivatives(Camera(
      "LENSMODEL_OPENCV8",
      {2800, 2810, 1490, 1010, -0.1, 0.02, 1e-3, -1e-3, 0.01, 0.02, 0.01, 0.005}, 3000, 2000));
}

TEST(LensResidual, OfAMetricCameraWithoutDistortionIsThePinholes) {
  for (const MetricModel model : {MetricModel::kBackwardBrown, MetricModel::kBalancedRadial}) {
    MetricCamera metric = Metric(model);
    metric.parameters = {24, 0.4, 0.81, 0, 0, 0, 0, 0, 0, 0};
    const Camera pinhole =
        Camera::Pinhole(24 / 0.008, 24 / 0.0081, 1499.5 + 50, 999.5 - 100, 3000, 2000);
    EXPECT_LT((ResidualOf(metric, metric.parameters, kPoint) -
               ResidualOf(pinhole, pinhole.intrinsics(), kPoint))
                  .norm(),
              1e-9);
  }
}

TEST(LensResidual, RefusesPointsBehindTheCamera) {
  const Lens lens = Metric(MetricModel::kBackwardBrown);
  Eigen::Vector2d residual;
  EXPECT_FALSE(
      LensResidual(lens, LensParameters(lens).data(), {0, 0, -1}, kObserved, &residual, {}));
}

}  // namespace
}  // namespace insitu
