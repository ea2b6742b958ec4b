// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/cosine_directions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"

namespace insitu {
namespace {

const Eigen::Vector3d kNormal = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();

double ShareWithin(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& axis,
                   double angle) {
  const auto inside = std::ranges::count_if(
      directions, [&](const Eigen::Vector3d& d) { return d.dot(axis) > std::cos(angle); });
  return static_cast<double>(inside) / static_cast<double>(directions.size());
}

TEST(CosineDirections, AreUnitAndAboveTheSurface) {
  for (const int count : {1, 15, 256, 1000}) {
    const CosineDirections directions(count);
    ASSERT_EQ(directions.count(), count);
    for (const Eigen::Vector3d& d : directions.About(kNormal)) {
      EXPECT_NEAR(d.norm(), 1, 1e-12);
      EXPECT_GT(d.dot(kNormal), 0);
    }
  }
}

// The mean of n.l over a cosine density is 2/3; across the normal nothing is left.
TEST(CosineDirections, MeanIsTwoThirdsOfTheNormal) {
  for (const int count : {256, 1024}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& d : CosineDirections(count).About(kNormal)) sum += d;
    EXPECT_LT((sum / count - 2.0 / 3 * kNormal).norm(), 0.004) << count;
  }
}

// A cap about the normal holds sin^2 of its half angle of the irradiance.
TEST(CosineDirections, CapAboutTheNormalHasItsShare) {
  const std::vector<Eigen::Vector3d> directions = CosineDirections(1024).About(kNormal);
  for (const double angle : {0.2, 0.5, 0.9, 1.3}) {
    const double share = std::pow(std::sin(angle), 2);
    EXPECT_NEAR(ShareWithin(directions, kNormal, angle), share, 0.01 * share + 1.0 / 1024) << angle;
  }
}

// Off the normal, and wholly above the surface, it holds sin^2 of it times the cosine.
TEST(CosineDirections, SlantingCapHasItsShare) {
  const std::vector<Eigen::Vector3d> directions = CosineDirections(4096).About(kNormal);
  const Eigen::Vector3d across = kNormal.unitOrthogonal();
  for (const double tilt : {0.3, 0.6, 0.9}) {
    const Eigen::Vector3d axis = std::cos(tilt) * kNormal + std::sin(tilt) * across;
    const double share = std::pow(std::sin(0.5), 2) * std::cos(tilt);
    EXPECT_NEAR(ShareWithin(directions, axis, 0.5), share, 0.01 * share) << tilt;
  }
}

TEST(CosineDirections, SixteenInARowLieClose) {
  const std::vector<Eigen::Vector3d> directions = CosineDirections(1024).About(kNormal);
  for (size_t first = 0; first < directions.size(); first += 16) {
    for (size_t i = 1; i < 16; ++i) {
      const Eigen::Vector3d apart = directions[first + i] - directions[first];
      // Sixteen of 1024 fill a sixty-fourth of the disc, some quarter of its radius wide.
      EXPECT_LT((apart - apart.dot(kNormal) * kNormal).norm(), 0.75);
    }
  }
}

TEST(CosineDirections, RefusesNone) { EXPECT_THROW(CosineDirections(0), CheckError); }

}  // namespace
}  // namespace insitu
