// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kGrid(2600000, 1200000, 450);

TEST(OutlineNormal, PointsToWhereTheOutlineTurnsCounterClockwise) {
  const std::vector<Vector3d> square = {kGrid, kGrid + Vector3d(2, 0, 0), kGrid + Vector3d(2, 0, 2),
                                        kGrid + Vector3d(0, 0, 2)};
  EXPECT_LT((OutlineNormal(square) - Vector3d(0, -1, 0)).norm(), 1e-15);
}

TEST(OutlineNormal, IsThatOfTheWholeOutlineEvenIfItIsConcaveAtTheStart) {
  const std::vector<Vector3d> arrow = {{1, 0.5, 0}, {0, 0, 0}, {3, 0.5, 0}, {0, 1, 0}};
  EXPECT_LT((OutlineNormal(arrow) - Vector3d(0, 0, 1)).norm(), 1e-15);
}

TEST(OutlineNormal, IsZeroWithoutArea) {
  EXPECT_EQ(OutlineNormal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), Vector3d::Zero());
}

TEST(FitPlane, HoldsTheResidualsOfATwistedQuadrilateral) {
  // Corners alternately 1 above and below: the best plane is the mean, each corner 1 off it.
  const Vector3d up = Vector3d(1, 2, 3).normalized(), right = up.unitOrthogonal();
  const Vector3d forward = up.cross(right);
  std::vector<Vector3d> corners;
  for (int k = 0; k < 4; ++k) {
    const double x = (k == 1 || k == 2) ? 5 : -5, y = k >= 2 ? 5 : -5;
    corners.push_back(kGrid + x * right + y * forward + (k % 2 ? 1 : -1) * up);
  }
  const Plane plane = FitPlane(corners);
  EXPECT_NEAR(std::abs(plane.normal.dot(up)), 1, 1e-12);
  for (const Vector3d& corner : corners) {
    EXPECT_NEAR(std::abs(plane.SignedDistance(corner)), 1, 1e-9);
  }
}

TEST(ProjectOutline, KeepsTheSenseOfRotation) {
  for (const Vector3d& normal : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                 Vector3d(0, -1, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
    const Vector3d right = normal.unitOrthogonal();
    const auto outline =
        ProjectOutline({Vector3d::Zero(), right, normal.cross(right)}, normal, Vector3d::Zero());
    const double turn = outline[1].x() * outline[2].y() - outline[1].y() * outline[2].x();
    EXPECT_NEAR(turn, 1, 1e-12) << normal.transpose();
  }
}

TEST(IsInside, FollowsTheNotchOfAConcaveOutline) {
  const std::vector<Vector2d> notched = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  EXPECT_TRUE(IsInside(notched, {2, 0.5}));
  EXPECT_TRUE(IsInside(notched, {0.5, 2.5}));
  EXPECT_FALSE(IsInside(notched, {2, 2}));
  EXPECT_FALSE(IsInside(notched, {5, 1}));
  EXPECT_FALSE(IsInside(notched, {-1, 1}));
  EXPECT_FALSE(IsInside({}, {1, 1}));
}

}  // namespace
}  // namespace insitu
