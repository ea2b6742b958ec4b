// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/photo_gain.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

const Eigen::Vector3d kGain(3, 1.7, 0.6);

TEST(BackToPhotograph, UntouchedPixelsAreThePhotographsBitForBit) {
  Raster photo(64, 1), in_unit(64, 1);
  for (int x = 0; x < 64; ++x) {
    photo.SetRgb(x, 0, Eigen::Vector3d(0.013, 0.017, 0.019) * (x + 1));
    in_unit.SetRgb(x, 0, photo.Rgb(x, 0).cwiseQuotient(kGain));
  }
  Raster result = in_unit;
  result.SetRgb(5, 0, {0.1, 0.2, 0.3});
  BackToPhotograph(photo, in_unit, kGain, &result);
  for (int x = 0; x < 64; ++x) {
    if (x == 5) continue;
    EXPECT_EQ(result.Rgb(x, 0), photo.Rgb(x, 0)) << x;
  }
  EXPECT_LT((result.Rgb(5, 0) - Eigen::Vector3d(0.3, 0.34, 0.18)).norm(), 1e-6);
}

// The noise of L / g is that of L over g.
TEST(GrainInUnit, IsThatOfTheDividedPhotograph) {
  const Grain grain{{1e-4, 2e-4, 3e-4}, {0.01, 0.02, 0.03}};
  const Eigen::Vector3d radiance(0.2, 0.3, 0.4);
  const Eigen::Vector3d expected =
      grain.Variance(radiance.cwiseProduct(kGain)).cwiseQuotient(kGain.cwiseAbs2());
  EXPECT_LT((GrainInUnit(grain, kGain).Variance(radiance) - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace insitu
