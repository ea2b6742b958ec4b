// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/rigid3.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

Rigid3 Pose(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())), translation};
}

const Rigid3 kBFromA = Pose(0.7, {1, -2, 0.5}, {3, -4, 5});
const Rigid3 kCFromB = Pose(-2.1, {0.3, 1, 2}, {-1, 0.2, 7});
const Eigen::Vector3d kPoint(0.4, -1.3, 2.2);

TEST(Rigid3, CompositionAppliesTheRightOneFirst) {
  EXPECT_LT(((kCFromB * kBFromA) * kPoint - kCFromB * (kBFromA * kPoint)).norm(), 1e-14);
}

TEST(Rigid3, InverseUndoes) {
  EXPECT_LT((Inverse(kBFromA) * (kBFromA * kPoint) - kPoint).norm(), 1e-14);
  const Rigid3 identity = kBFromA * Inverse(kBFromA);
  EXPECT_LT(identity.translation.norm(), 1e-14);
  EXPECT_LT(identity.rotation.vec().norm(), 1e-15);
}

TEST(Rigid3, CenterIsWhereTheCameraStands) { EXPECT_LT((kBFromA * Center(kBFromA)).norm(), 1e-14); }

TEST(Rigid3, QuarterTurnInClosedForm) {
  const Rigid3 turn = Pose(std::acos(-1.0) / 2, {0, 0, 1}, {10, 0, 0});
  EXPECT_LT((turn * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(10, 1, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace insitu
