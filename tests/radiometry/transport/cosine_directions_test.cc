// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/cosine_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

const Eigen::Vector3d kNormal = Eigen::Vector3d(1, -2, 3).normalized();

TEST(CosineDirections, AreAsDenseAsTheCosine) {
  const std::vector<Eigen::Vector3d> directions = CosineDirections(1024).About(kNormal);
  ASSERT_EQ(directions.size(), 1024u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : directions) {
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    EXPECT_GT(direction.dot(kNormal), 0);
    sum += direction;
  }
  // The mean of a direction weighted by its cosine is 2/3 of the normal.
  EXPECT_LT((sum / 1024 - 2.0 / 3 * kNormal).norm(), 0.002);
}

TEST(CosineDirections, ACapHoldsItsShare) {
  const std::vector<Eigen::Vector3d> directions = CosineDirections(1024).About(kNormal);
  for (const double degrees : {20.0, 45.0, 70.0}) {
    const double angle = degrees * M_PI / 180;
    const auto inside = std::ranges::count_if(directions, [&](const Eigen::Vector3d& direction) {
      return direction.dot(kNormal) > std::cos(angle);
    });
    EXPECT_NEAR(static_cast<double>(inside) / 1024, std::pow(std::sin(angle), 2), 0.002) << degrees;
  }
}

}  // namespace
}  // namespace insitu
