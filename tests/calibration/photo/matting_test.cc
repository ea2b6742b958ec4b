// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/matting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 120, kHeight = 90;

Vector3d Leaf(int x, int y) {
  return Vector3d(0.03, 0.08, 0.01) * (1 + 0.3 * std::sin(0.05 * x + 0.1 * y));
}
Vector3d Sky(int x, int y) { return {0.4 + 0.001 * x, 0.5, 0.8 - 0.002 * y}; }

// A crown with a frayed edge: narrow leaves that a pixel does not hold whole.
Raster Crown() {
  Raster share(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double angle = std::atan2(y - 45, x - 60);
      const double inside = 30 + 4 * std::sin(23 * angle) - std::hypot(x - 60, y - 45);
      *share.At(x, y) = static_cast<float>(std::clamp(inside / 2 + 0.5, 0.0, 1.0));
    }
  }
  return share;
}

Raster Mixed(const Raster& share) {
  Raster photo(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double m = *share.At(x, y);
      photo.SetRgb(x, y, m * Leaf(x, y) + (1 - m) * Sky(x, y));
    }
  }
  return photo;
}

// Drawn by hand: two circles, grey between.
Raster Drawn() {
  Raster trimap(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double radius = std::hypot(x - 60, y - 45);
      *trimap.At(x, y) = radius < 24 ? 1 : radius > 37 ? 0 : 0.3f;
    }
  }
  return trimap;
}

TEST(EstimateMatte, FindsFrayedLeavesBetweenTwoCircles) {
  const Raster truth = Crown(), matte = EstimateMatte(Mixed(truth), Drawn());
  double sum = 0, worst = 0;
  int count = 0;
  for (size_t i = 0; i < truth.data.size(); ++i) {
    const double off = std::abs(matte.data[i] - truth.data[i]);
    worst = std::max(worst, off);
    if (truth.data[i] <= 0 || truth.data[i] >= 1) continue;
    sum += off;
    ++count;
  }
  EXPECT_LT(sum / count, 0.02);
  EXPECT_LT(worst, 0.15);
}

TEST(EstimateMatte, KeepsWhatIsDrawn) {
  const Raster drawn = Drawn();
  const Raster matte = EstimateMatte(Mixed(Crown()), drawn);
  for (size_t i = 0; i < drawn.data.size(); ++i) {
    const bool is_stated = drawn.data[i] == 0 || drawn.data[i] == 1;
    ASSERT_TRUE(!is_stated || matte.data[i] == drawn.data[i]);
    ASSERT_GE(matte.data[i], 0);
    ASSERT_LE(matte.data[i], 1);
  }
}

TEST(EstimateMatte, OfAPhotographOfOneColorIsSmoothAndEnds) {
  Raster grey(kWidth, kHeight);
  std::ranges::fill(grey.data, 0.2f);
  const Raster matte = EstimateMatte(grey, Drawn());
  for (const float share : matte.data) ASSERT_TRUE(share >= 0 && share <= 1);
  EXPECT_GT(*matte.At(60 + 27, 45), *matte.At(60 + 34, 45));
}

}  // namespace
}  // namespace insitu
