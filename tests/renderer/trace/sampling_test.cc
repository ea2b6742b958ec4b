// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

TEST(PixelSampler, SpreadIsAGaussianCutOff) {
  const PixelSampler sampler(3, 4);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
  double farthest = 0;
  for (int ray = 0; ray < 4096; ++ray) {
    const Eigen::Vector2d offset = sampler.Spread(ray, 0.6);
    farthest = std::max(farthest, offset.norm());
    mean += offset / 4096;
    moment += offset * offset.transpose() / 4096;
  }
  EXPECT_LT(mean.norm(), 2e-3);
  EXPECT_TRUE(moment.isApprox(0.36 * Eigen::Matrix2d::Identity(), 0.01)) << moment;
  EXPECT_GT(farthest, 2.9 * 0.6);
  EXPECT_LT(farthest, kSpreadReach * 0.6);
}

TEST(PixelSampler, SpreadsOverThePixelAndDependsOnItAlone) {
  const PixelSampler sampler(3, 4);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int ray = 0; ray < 4096; ++ray) {
    const Eigen::Vector2d offset = sampler.InPixel(ray);
    ASSERT_TRUE((offset.array() >= -0.5).all() && (offset.array() < 0.5).all());
    mean += offset / 4096;
  }
  EXPECT_LT(mean.norm(), 2e-3);
  EXPECT_EQ(PixelSampler(3, 4).InPixel(7), sampler.InPixel(7));
  EXPECT_NE(PixelSampler(4, 3).InPixel(7), sampler.InPixel(7));
}

TEST(ColorStatistics, StandardErrorOfTheMean) {
  ColorStatistics statistics;
  for (int i = 0; i < 8; ++i) statistics.Add(Eigen::Vector3d::Constant(i % 2));
  // Values 0 and 1 alike: variance 1/4, eight of them, seven degrees of freedom.
  EXPECT_NEAR(statistics.StandardError(), std::sqrt(0.25 / 7), 1e-9);
}

}  // namespace
}  // namespace insitu
