// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/color/srgb_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace insitu {
namespace {

int ByPower(float linear) {
  return static_cast<int>(std::lround(255 * SrgbFromLinear(std::clamp(linear, 0.f, 1.f))));
}

TEST(NearestSrgbCode, IsThePowersOnBothSidesOfEveryStep) {
  for (int code = 1; code <= 255; ++code) {
    auto linear = static_cast<float>(LinearFromSrgb((code - 0.5) / 255));
    for (int i = 0; i < 8; ++i) linear = std::nextafter(linear, 0.f);
    for (int i = 0; i < 16; ++i, linear = std::nextafter(linear, 1.f)) {
      ASSERT_EQ(NearestSrgbCode(linear), ByPower(linear)) << linear;
    }
  }
}

TEST(NearestSrgbCode, IsThePowersEverywhere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> even(-0.1f, 1.1f), power(-40, 1);
  for (int i = 0; i < 200000; ++i) {
    const float linear = i % 2 == 0 ? even(random) : std::exp2(power(random));
    ASSERT_EQ(NearestSrgbCode(linear), ByPower(linear)) << linear;
  }
}

TEST(NearestSrgbCode, BeyondIsClampedAndNoNumberIsBlack) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(NearestSrgbCode(kInfinite), 255);
  EXPECT_EQ(NearestSrgbCode(std::nextafter(1.f, 0.f)), 255);
  EXPECT_EQ(NearestSrgbCode(-kInfinite), 0);
  EXPECT_EQ(NearestSrgbCode(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(NearestSrgbCode(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace insitu
