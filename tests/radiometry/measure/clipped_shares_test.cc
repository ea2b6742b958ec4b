// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/clipped_shares.h"

#include <gtest/gtest.h>

#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

// The wall is white in photograph A; of B a corner of the sky alone, which is no polygon.
TEST(MeasureClippedShares, TellsThePolygonAndThePhotograph) {
  const SyntheticSite synthetic = MakeSyntheticSite("clipped_shares");
  std::vector<Photograph> photos(2);
  for (int i = 0; i < 2; ++i) {
    photos[i].linear = Raster(900, 600);
    std::ranges::fill(photos[i].linear.data, 0.5F);
  }
  EXPECT_TRUE(MeasureClippedShares(synthetic.scene, photos).empty());
  photos[1].linear.SetRgb(1, 1, Eigen::Vector3d::Ones());
  int wall_pixels = 0;
  for (int y = 0; y < 600; ++y) {
    for (int x = 0; x < 900; ++x) {
      if (!PointOnPolygon(synthetic.scene.cameras[0], Eigen::Vector2d(x, y),
                          synthetic.scene.polygons[1])) {
        continue;
      }
      if (++wall_pixels % 4 == 0) photos[0].linear.SetRgb(x, y, {0.2, 1, 0.2});
    }
  }
  const auto shares = MeasureClippedShares(synthetic.scene, photos);
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0].photo, 0);
  EXPECT_EQ(synthetic.scene.polygons[shares[0].polygon].name, "wall");
  EXPECT_NEAR(shares[0].share, 0.25, 0.05);
}

}  // namespace
}  // namespace insitu
