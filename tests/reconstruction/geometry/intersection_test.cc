// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/intersection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace insitu {
namespace {

using Eigen::Vector3d;

const Vector3d kGrid(2600000, 1200000, 450);

PosedCamera CameraAt(const Vector3d& center, double turn) {
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn, Vector3d::UnitY()));
  const Camera camera("LENSMODEL_OPENCV8", {1500, 1500, 900, 600, -0.1, 0.02, 0, 0, 0, 0, 0, 0},
                      1800, 1200);
  return {"photo", camera, {rotation, -(rotation * center)}};
}

Sight SightOf(const PosedCamera& camera, const Vector3d& point) {
  return {&camera, *camera.camera.Project(camera.cam_from_world * point)};
}

TEST(Intersect, ReturnsThePointThatWasSeen) {
  const PosedCamera left = CameraAt(kGrid, 0.1), right = CameraAt(kGrid + Vector3d(5, 1, 0), -0.2),
                    third = CameraAt(kGrid + Vector3d(2, 4, 1), 0);
  const Vector3d point = kGrid + Vector3d(2, 1.5, 20);
  const auto found =
      Intersect({SightOf(left, point), SightOf(right, point), SightOf(third, point)});
  ASSERT_TRUE(found);
  EXPECT_LT((*found - point).norm(), 1e-8);
}

TEST(Intersect, HalvesTheGapBetweenTwoRays) {
  const Camera camera = Camera::Pinhole(1000, 1000, 0, 0, 10, 10);
  // The axes of two cameras, one looking along z at y = 0, one along x at y = 0.5.
  const PosedCamera first{"a", camera, {}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  const PosedCamera second{"b", camera, {turn, -(turn * Vector3d(-7, 0.5, 9))}};
  const auto found = Intersect({{&first, {0, 0}}, {&second, {0, 0}}});
  ASSERT_TRUE(found);
  EXPECT_LT((*found - Vector3d(0, 0.25, 9)).norm(), 1e-12);
}

TEST(Intersect, RefusesOneRayAndNearlyParallelRays) {
  const PosedCamera left = CameraAt(kGrid, 0), right = CameraAt(kGrid + Vector3d(0.01, 0, 0), 0);
  const Vector3d point = kGrid + Vector3d(0, 0, 20);
  EXPECT_FALSE(Intersect({SightOf(left, point)}));
  EXPECT_FALSE(Intersect({SightOf(left, point), SightOf(right, point)}));
  EXPECT_TRUE(Intersect({SightOf(left, point), SightOf(right, point)}, 1e-4));
}

TEST(Intersect, RefusesAPointBehindTheCameras) {
  const PosedCamera left = CameraAt({0, 0, 0}, 0), right = CameraAt({5, 0, 0}, 0);
  // Diverging rays meet behind.
  EXPECT_FALSE(Intersect({SightOf(left, {-3, 0, 20}), SightOf(right, {8, 0, 20})}));
}

TEST(IntersectPlane, MeetsThePlane) {
  const PosedCamera camera = CameraAt(kGrid, 0.1);
  const Vector3d point = kGrid + Vector3d(2, 1.5, 20), normal = Vector3d(1, 2, -3).normalized();
  const auto found = IntersectPlane(SightOf(camera, point), normal, normal.dot(point));
  ASSERT_TRUE(found);
  EXPECT_LT((*found - point).norm(), 1e-8);
}

TEST(IntersectPlane, RefusesAPlaneBehindOrAlongTheSight) {
  const Camera pinhole = Camera::Pinhole(1000, 1000, 0, 0, 10, 10);
  const PosedCamera camera{"a", pinhole, {}};
  EXPECT_FALSE(IntersectPlane({&camera, {0, 0}}, {0, 0, 1}, -5));
  EXPECT_FALSE(IntersectPlane({&camera, {0, 0}}, {0, 1, 0}, 5));
}

}  // namespace
}  // namespace insitu
