// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/best_photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

using Eigen::Vector3d;

PosedCamera At(const Vector3d& center, double focal = 1000) {
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(2) = -center.normalized();
  cam_from_world.row(0) = (-center).cross(Vector3d::UnitZ()).normalized();
  cam_from_world.row(1) = cam_from_world.row(2).cross(cam_from_world.row(0));
  const Eigen::Quaterniond rotation(cam_from_world);
  return {
      "p", Camera::Pinhole(focal, focal, 500, 400, 1001, 801), {rotation, -(rotation * center)}};
}

// A wall in the plane y = 0 that is seen from the south.
const std::vector<Vector3d> kWall = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};

TEST(RankPhotosOf, PrefersNearAndSquare) {
  const std::vector<PosedCamera> cameras = {At({0, -19, 0}),  At({0, -10, 0}), At({10, -10, 0}),
                                            At({9.9, -1, 0}), At({0, 10, 0}),  At({0, -1.5, 0})};
  const auto ranking = RankPhotosOf(cameras, kWall);
  ASSERT_EQ(ranking.size(), 4u);  // not from behind, nor so near that it leaves the frame
  EXPECT_EQ(ranking[0].photo, 1u);
  EXPECT_EQ(ranking[1].photo, 0u);
  EXPECT_NEAR(ranking[0].mm_per_px, 10, 1e-9);
  EXPECT_NEAR(ranking[0].angle, 0, 1e-6);
  EXPECT_NEAR(ranking[0].score, 100, 1e-9);
  const auto oblique = std::find_if(ranking.begin(), ranking.end(),
                                    [](const auto& photo) { return photo.photo == 2; });
  ASSERT_NE(oblique, ranking.end());
  EXPECT_NEAR(oblique->angle, M_PI / 4, 1e-9);
  EXPECT_EQ(ranking[3].photo, 3u);
}

TEST(RankPhotosOf, TakesTheBackWhereNothingElseIs) {
  std::vector<Vector3d> turned(kWall.rbegin(), kWall.rend());
  const auto ranking = RankPhotosOf({At({0, -20, 0}), At({0, -10, 0})}, turned);
  ASSERT_EQ(ranking.size(), 2u);
  EXPECT_EQ(ranking[0].photo, 1u);
}

}  // namespace
}  // namespace insitu
