// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/image_quality.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

TEST(UnitGrain, HasUnitVarianceAndTheCorrelationsAskedFor) {
  Grain grain;
  grain.length = 0.7;
  grain.shared = 0.4;
  constexpr int kSide = 200;
  double variance = 0, next = 0, channels = 0, mean = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Eigen::Vector3d here = UnitGrain(grain, x, y, 3);
      const Eigen::Vector3d beside = UnitGrain(grain, x + 1, y, 3);
      mean += here[1];
      variance += here[1] * here[1];
      next += here[1] * beside[1];
      channels += here[0] * here[2];
    }
  }
  constexpr double kCount = kSide * kSide;
  EXPECT_NEAR(mean / kCount, 0, 0.03);
  EXPECT_NEAR(variance / kCount, 1, 0.03);
  EXPECT_NEAR(next / kCount, std::exp(-0.25 / (0.7 * 0.7)), 0.03);
  EXPECT_NEAR(channels / kCount, 0.4, 0.03);
}

TEST(UnitGrain, IsAFunctionOfThePixel) {
  const Grain grain;
  EXPECT_EQ(UnitGrain(grain, 5, 6, 0), UnitGrain(grain, 5, 6, 0));
  EXPECT_NE(UnitGrain(grain, 5, 6, 0), UnitGrain(grain, 6, 5, 0));
  EXPECT_NE(UnitGrain(grain, 5, 6, 0), UnitGrain(grain, 5, 6, 1));
}

}  // namespace
}  // namespace insitu
