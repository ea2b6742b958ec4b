// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/foreground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

constexpr int kWidth = 70, kHeight = 50;

const Eigen::Vector3d kLeaf(0.03, 0.08, 0.01);

Eigen::Vector3d Sky(int x, int y) { return {0.4 + 0.002 * x, 0.5, 0.8 - 0.004 * y}; }

// A crown with soft edges and holes finer than they are wide.
Raster Crown() {
  Raster share(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double inside = 20 - std::hypot(x - 35, y - 25);
      const double leaves = 0.75 + 0.75 * std::sin(0.9 * x) * std::sin(0.8 * y);
      *share.At(x, y) = static_cast<float>(std::clamp(std::min(inside / 3, leaves), 0.0, 1.0));
    }
  }
  return share;
}

Raster Mixed(const Raster& share) {
  Raster photo(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double m = *share.At(x, y);
      photo.SetRgb(x, y, m * kLeaf + (1 - m) * Sky(x, y));
    }
  }
  return photo;
}

TEST(SeparateForeground, TakesLeavesAndSkyApart) {
  const Raster share = Crown(), photo = Mixed(share);
  const Foreground foreground = SeparateForeground(photo, share);
  const Eigen::Vector3d wall(0.2, 0.15, 0.1);  // stands behind now
  double worst = 0, worst_without = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double m = *share.At(x, y);
      if (m <= 0 || m >= 1) continue;
      const Eigen::Vector3d truth = m * kLeaf + (1 - m) * wall;
      const Eigen::Vector3d now = photo.Rgb(x, y) + (1 - m) * (wall - foreground.behind.Rgb(x, y));
      const Eigen::Vector3d halo = m * photo.Rgb(x, y) + (1 - m) * wall;
      worst = std::max(worst, (now - truth).norm());
      worst_without = std::max(worst_without, (halo - truth).norm());
    }
  }
  EXPECT_GT(worst_without, 0.15);
  EXPECT_LT(worst, 0.02);
}

TEST(SeparateForeground, KeepsThePhotographWhereThereIsNothingToTakeApart) {
  Raster share = Crown();
  const Raster photo = Mixed(share);
  const Foreground soft = SeparateForeground(photo, share);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float m = *share.At(x, y);
      if (m > 0 && m < 1) continue;
      EXPECT_EQ(soft.behind.Rgb(x, y), photo.Rgb(x, y));
    }
  }
  for (float& m : share.data) m = m > 0.5f ? 1.0f : 0.0f;
  EXPECT_EQ(SeparateForeground(photo, share).behind.data, photo.data);
}

TEST(SeparateForeground, NeitherPartIsNegativeWhateverTheMatte) {
  Raster share(kWidth, kHeight, 1);
  Raster photo(kWidth, kHeight);
  for (size_t i = 0; i < share.data.size(); ++i) {
    share.data[i] = static_cast<float>(i * 7919 % 101) / 100;
  }
  for (size_t i = 0; i < photo.data.size(); ++i) {
    photo.data[i] = static_cast<float>(i * 104729 % 103) / 100;
  }
  const Foreground foreground = SeparateForeground(photo, share);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double m = *share.At(x, y);
      if (m <= 0 || m >= 1) continue;
      const Eigen::Vector3d behind = foreground.behind.Rgb(x, y);
      EXPECT_GE(behind.minCoeff(), 0);
      EXPECT_GE((photo.Rgb(x, y) - (1 - m) * behind).minCoeff(), -1e-6);
    }
  }
}

}  // namespace
}  // namespace insitu
