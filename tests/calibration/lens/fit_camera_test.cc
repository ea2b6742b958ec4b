// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/fit_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

SightOfPixel SightsOf(const Camera& camera) {
  return [camera](const Eigen::Vector2d& pixel) {
    return std::optional<Eigen::Vector3d>(camera.Unproject(pixel));
  };
}

TEST(FitCamera, FindsALensOfItsOwnKindAgain) {
  const Camera lens("LENSMODEL_OPENCV5", {1500, 1505, 910, 580, -0.21, 0.11, 4e-4, -7e-4, -0.03},
                    1800, 1200);
  const auto fit = FitCamera(SightsOf(lens), 1800, 1200);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_deviation_px, 1e-4);
  EXPECT_EQ(fit->camera.lens_model(), "LENSMODEL_OPENCV8");
}

// A shifted lens, or a crop: the principal point lies outside the frame.
TEST(FitCamera, PrincipalPointOutsideTheFrame) {
  const Camera lens("LENSMODEL_OPENCV4", {2400, 2400, 700, 1900, -0.08, 0.03, 0, 0}, 1400, 1000);
  const auto fit = FitCamera(SightsOf(lens), 1400, 1000);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_deviation_px, 1e-3);
  EXPECT_NEAR(fit->camera.intrinsics()[3], 1900, 1);
}

TEST(FitCamera, DeviationIsTheTruth) {
  // A ripple that no lens model of mrcal has: 0.3 px across the frame.
  const Camera plain = Camera::Pinhole(800, 800, 319.5, 239.5, 640, 480);
  const auto sight = [&](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector3d> {
    return plain.Unproject(pixel + Eigen::Vector2d(0.3 * std::sin(pixel.y() / 20), 0));
  };
  const auto fit = FitCamera(sight, 640, 480);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->largest_deviation_px, 0.3, 0.03);
  EXPECT_NEAR(fit->rms_deviation_px, 0.3 / std::sqrt(2.0), 0.02);
}

// The scan of a photograph, laid in upside down.
TEST(FitCamera, TurnsTheAxes) {
  const Camera lens("LENSMODEL_OPENCV4", {800, 800, 300, 250, -0.1, 0, 0, 0}, 640, 480);
  const Eigen::Quaterniond half_turn(Eigen::AngleAxisd(M_PI + 0.01, Eigen::Vector3d::UnitZ()));
  const auto sight = [&](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector3d> {
    return half_turn.inverse() * lens.Unproject(pixel);
  };
  FitCameraOptions options;
  options.turn_axes = true;
  options.start_fit_from_lens = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
  const auto fit = FitCamera(sight, 640, 480, options);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_deviation_px, 1e-3);
  EXPECT_LT(fit->fit_from_lens.angularDistance(half_turn), 1e-2);
}

TEST(FitCamera, RefusesWhatIsNoPlaneImage) {
  const auto behind = [](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector3d> {
    return Eigen::Vector3d(pixel.x() - 320, pixel.y() - 240, -500);
  };
  EXPECT_FALSE(FitCamera(behind, 640, 480));
  const auto mirrored = [](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector3d> {
    return Eigen::Vector3d(320 - pixel.x(), pixel.y() - 240, 500);
  };
  EXPECT_FALSE(FitCamera(mirrored, 640, 480));
  const auto nowhere = [](const Eigen::Vector2d&) { return std::optional<Eigen::Vector3d>(); };
  EXPECT_FALSE(FitCamera(nowhere, 640, 480));
}

}  // namespace
}  // namespace insitu
