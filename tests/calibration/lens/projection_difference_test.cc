// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/projection_difference.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

Camera Lens(double focal, double center_x, double k1) {
  return Camera("LENSMODEL_OPENCV4", {focal, focal, center_x, 400, k1, 0, 0, 0}, 1200, 800);
}

TEST(ProjectionDifference, OfALensAgainstItselfIsNone) {
  const ProjectionDifference same =
      CompareLenses(Lens(900, 600, -0.1), Lens(900, 600, -0.1), 13, 9);
  EXPECT_EQ(same.px.size(), 117u);
  EXPECT_LT(same.largest_px, 1e-9);
}

// A shifted principal point is nearly a turned camera; what is left grows with the field of view.
TEST(ProjectionDifference, ATurnIsNoDifference) {
  const Camera a = Lens(9000, 600, 0), b = Lens(9000, 605, 0);
  const ProjectionDifference difference = CompareLenses(a, b, 13, 9);
  EXPECT_LT(difference.largest_px, 0.04);
  const Eigen::AngleAxisd turn(difference.b_from_a);
  EXPECT_NEAR(turn.angle(), 5.0 / 9000, 1e-6);
  EXPECT_GT(std::abs(turn.axis().y()), 0.9999);
}

// Another focal length is: by the distance from the middle, however the camera turns.
TEST(ProjectionDifference, AScaleStays) {
  const ProjectionDifference difference =
      CompareLenses(Lens(900, 599.5, 0), Lens(909, 599.5, 0), 13, 9);
  ASSERT_TRUE(difference.px[size_t{4} * 13]);
  const double off_middle = 600 - 1200.0 / 13 / 2;  // halfway down, the leftmost cell
  EXPECT_NEAR(*difference.px[size_t{4} * 13], 0.01 * off_middle, 0.01);
  EXPECT_LT(*difference.px[size_t{4} * 13 + 6], 0.01);  // the middle
}

TEST(FrameCenters, AreTheMiddlesOfEqualCells) {
  const auto centers = FrameCenters(4, 2, 2, 1);
  ASSERT_EQ(centers.size(), 2u);  // pixels 0 and 1, 2 and 3
  EXPECT_EQ(centers[0], Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(centers[1], Eigen::Vector2d(2.5, 0.5));
}

// Where nothing is known of a lens it does not pull at the rotation.
TEST(ProjectionDifference, WeightsSayWhereToLook) {
  const Camera a = Lens(900, 600, 0), b = Lens(909, 610, 0);
  std::vector<double> left(117, 0);
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 4; ++column) left[13 * row + column] = 1;
  }
  const ProjectionDifference everywhere = CompareLenses(a, b, 13, 9);
  const ProjectionDifference there = CompareLenses(a, b, 13, 9, left);
  EXPECT_LT(*there.px[4 * 13 + 1], *everywhere.px[4 * 13 + 1]);
  EXPECT_GT(*there.px[4 * 13 + 12], *everywhere.px[4 * 13 + 12]);
}

}  // namespace
}  // namespace insitu
