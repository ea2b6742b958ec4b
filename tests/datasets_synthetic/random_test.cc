// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu::demo {
namespace {

TEST(Random, RepeatsAStreamAndSeparatesStreams) {
  Random a(1, 2, 3), again(1, 2, 3), other(1, 2, 4), swapped(2, 1, 3);
  const uint64_t first = a.Bits();
  EXPECT_EQ(first, again.Bits());
  EXPECT_NE(first, other.Bits());
  EXPECT_NE(first, swapped.Bits());
}

TEST(Random, HasTheMomentsOfItsDistributions) {
  constexpr int kDraws = 40000;
  Random random(7, 0, 0);
  double uniform = 0, mean = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.Uniform(), g = random.Gaussian();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    uniform += u / kDraws;
    mean += g / kDraws;
    square += g * g / kDraws;
  }
  EXPECT_NEAR(uniform, 0.5, 5 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NEAR(mean, 0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / kDraws));
}

TEST(ValueNoise, PassesThroughItsLatticeAndIsContinuous) {
  EXPECT_NEAR(ValueNoise(3, -5, 9), CellNoise(3, -5, 9), 1e-15);
  for (double u = -2; u < 2; u += 0.13) {
    const double here = ValueNoise(u, 0.4, 9);
    EXPECT_GE(here, 0);
    EXPECT_LT(here, 1);
    EXPECT_NEAR(here, ValueNoise(u + 1e-6, 0.4, 9), 1e-5);
  }
  for (int i = -2; i <= 2; ++i) {  // from cell to cell
    EXPECT_NEAR(ValueNoise(i - 1e-9, 0.4, 9), ValueNoise(i + 1e-9, 0.4, 9), 1e-6) << i;
    EXPECT_NEAR(ValueNoise(0.4, i - 1e-9, 9), ValueNoise(0.4, i + 1e-9, 9), 1e-6) << i;
  }
}

}  // namespace
}  // namespace insitu::demo
