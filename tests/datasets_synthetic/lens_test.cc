// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/lens.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace insitu::demo {
namespace {

using Eigen::Vector2d;

TEST(Lens, UndistortInvertsDistortAllOverTheFrame) {
  const Lens lens = DemoLens(960, 640);
  for (double x = -0.56; x <= 0.56; x += 0.08) {
    for (double y = -0.38; y <= 0.38; y += 0.08) {
      const Vector2d tangents(x, y);
      EXPECT_LT((Undistort(lens, Distort(lens, tangents)) - tangents).norm(), 1e-12);
    }
  }
}

// x (1 + k1 r^2 + k2 r^4) + tangential terms, by hand at (0.5, 0).
TEST(Lens, DistortsAsOpenCvWritesIt) {
  Lens lens;
  lens.distortion = {-0.1, 0.02, 0.001, 0.002, 0, 0, 0, 0};
  const Vector2d seen = Distort(lens, {0.5, 0});
  EXPECT_NEAR(seen.x(), 0.5 * (1 - 0.1 * 0.25 + 0.02 * 0.0625) + 0.002 * 3 * 0.25, 1e-15);
  EXPECT_NEAR(seen.y(), 0.001 * 0.25, 1e-15);
}

TEST(Lens, BarrelDistortionPullsTheCornersIn) {
  const Lens lens = DemoLens(960, 640);
  EXPECT_LT(Distort(lens, {0.5, 0.3}).norm(), Vector2d(0.5, 0.3).norm() - 0.005);
}

TEST(Lens, ProjectsTheAxisToThePrincipalPointAndNothingFromBehind) {
  const Lens lens = DemoLens(960, 640);
  const auto pixel = Project(lens, Eigen::Vector3d(0, 0, 7));
  ASSERT_TRUE(pixel);
  EXPECT_EQ(*pixel, Vector2d(lens.center_x, lens.center_y));
  EXPECT_FALSE(Project(lens, Eigen::Vector3d(0, 0, -7)));
}

TEST(SightTable, InvertsProjection) {
  const Lens lens = DemoLens(960, 640);
  const SightTable sights(lens);
  for (const Vector2d& pixel :
       {Vector2d(-0.5, -0.5), Vector2d(0, 0), Vector2d(400.3, 377.9), Vector2d(959.4, 639.5)}) {
    const auto back = Project(lens, sights.Tangents(pixel).homogeneous());
    ASSERT_TRUE(back);
    EXPECT_LT((*back - pixel).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace insitu::demo
