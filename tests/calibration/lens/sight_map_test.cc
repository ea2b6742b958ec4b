// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/sight_map.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/files/error.h"

namespace insitu {
namespace {

Camera RealLens() {
  return Camera("LENSMODEL_OPENCV8",
                {1502.35, 1501.58, 907.95, 595.19, -0.117, 0.032, 0.00037, -0.00044, -0.006, 0.0047,
                 -0.00067, -0.0018},
                1800, 1200);
}

TEST(SightMap, WithinATenThousandthOfAPixelOfTheLens) {
  const Camera camera = RealLens();
  const SightMap map(camera);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-0.5, 1799.5), y(-0.5, 1199.5);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d pixel(x(random), y(random));
    const auto back = camera.Project(map.Direction(pixel));
    ASSERT_TRUE(back);
    ASSERT_LT((*back - pixel).norm(), 1e-4) << pixel.transpose();
  }
}

TEST(SightMap, CoversTheFrameToItsCorners) {
  const Camera camera = RealLens();
  const SightMap map(camera);
  for (const double x : {-0.5, 0.0, 1799.0, 1799.5}) {
    for (const double y : {-0.5, 0.0, 1199.0, 1199.5}) {
      const Eigen::Vector2d pixel(x, y);
      EXPECT_LT((*camera.Project(map.Direction(pixel)) - pixel).norm(), 1e-4);
    }
  }
  EXPECT_THROW(map.Tangents({-1, 5}), CheckError);
  EXPECT_THROW(map.Tangents({5, 1300}), CheckError);
}

TEST(SightMap, PinholeIsExact) {
  const Camera camera = Camera::Pinhole(500, 510, 160, 121, 323, 245);
  const SightMap map(camera);
  const Eigen::Vector2d tangents = map.Tangents({17.3, 201.9});
  EXPECT_NEAR(tangents.x(), (17.3 - 160) / 500, 1e-13);
  EXPECT_NEAR(tangents.y(), (201.9 - 121) / 510, 1e-13);
}

}  // namespace
}  // namespace insitu
