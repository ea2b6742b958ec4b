// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/raster.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// Bilinear in both directions, so that bilinear interpolation returns it exactly.
Eigen::Vector3d Plane(double x, double y) { return {1 + 2 * x, 3 - y, 0.5 * x * y}; }

Raster PlaneImage(int width, int height) {
  Raster image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.SetRgb(x, y, Plane(x, y));
  }
  return image;
}

TEST(Interpolate, PixelCentresAreTheFilesOwnValues) {
  const Raster image = PlaneImage(5, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(Interpolate(image, Eigen::Vector2d(x, y)), image.Rgb(x, y));
    }
  }
}

TEST(Interpolate, BilinearBetweenCentres) {
  const Raster image = PlaneImage(5, 4);
  EXPECT_LT((Interpolate(image, {2.25, 1.75}) - Plane(2.25, 1.75)).norm(), 1e-6);
}

TEST(Interpolate, NearestValueBeyondTheOutermostCentres) {
  const Raster image = PlaneImage(5, 4);
  EXPECT_EQ(Interpolate(image, {-7, -0.5}), image.Rgb(0, 0));
  EXPECT_EQ(Interpolate(image, {4.5, 3.4}), image.Rgb(4, 3));
}

TEST(Interpolate, RefusesAnEmptyImage) { EXPECT_THROW(Interpolate(Raster(), {0, 0}), CheckError); }

}  // namespace
}  // namespace insitu
