// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/undistort.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/files/error.h"

namespace insitu {
namespace {

Camera BarrelLens() {
  return Camera("LENSMODEL_OPENCV4", {300, 302, 163, 118, -0.2, 0.03, 0.001, -0.002}, 320, 240);
}

Camera PincushionLens() {
  return Camera("LENSMODEL_OPENCV4", {300, 302, 163, 118, 0.15, 0.02, 0, 0}, 320, 240);
}

// A smooth light over directions of sight: the same for every camera that looks at it.
Eigen::Vector3d Light(const Eigen::Vector3d& sight) {
  const Eigen::Vector2d t = sight.hnormalized();
  return {0.5 + 0.3 * std::sin(6 * t.x()), 0.4 + 0.2 * std::cos(5 * t.y() + t.x()),
          0.6 + 0.3 * std::sin(4 * t.x() * t.y())};
}

Raster PhotoOfLight(const Camera& camera) {
  Raster photo(camera.width(), camera.height());
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      photo.SetRgb(x, y, Light(camera.Unproject(Eigen::Vector2d(x, y))));
    }
  }
  return photo;
}

TEST(PinholeCovering, HoldsThePhotographsWholeBorder) {
  for (const Camera& lens : {BarrelLens(), PincushionLens()}) {
    const Camera pinhole = PinholeCovering(lens);
    for (int i = 0; i <= 100; ++i) {
      const double x = -0.5 + 320 * i / 100.0, y = -0.5 + 240 * i / 100.0;
      const Eigen::Vector2d border[] = {{x, -0.5}, {x, 239.5}, {-0.5, y}, {319.5, y}};
      for (const Eigen::Vector2d& pixel : border) {
        const auto mapped = MapPixel(pinhole, lens, pixel);
        ASSERT_TRUE(mapped);
        const Eigen::Vector2d inward = (*mapped - Eigen::Vector2d(159.5, 119.5)) * (1 - 1e-4);
        EXPECT_TRUE(pinhole.Sees(inward + Eigen::Vector2d(159.5, 119.5))) << mapped->transpose();
      }
    }
    EXPECT_EQ(pinhole.lens_model(), "LENSMODEL_PINHOLE");
    EXPECT_EQ(pinhole.width(), lens.width());
    EXPECT_EQ(pinhole.height(), lens.height());
  }
}

TEST(PinholeCovering, KeepsTheScaleWhereTheFrameAllows) {
  // Pincushion corners pull inwards: the frame holds them at the lens's own scale.
  EXPECT_NEAR(PinholeCovering(PincushionLens()).focal_px(), 301, 1.5);
  EXPECT_LT(PinholeCovering(BarrelLens()).focal_px(), 295);
}

TEST(PinholeCovering, OfAPinholeIsItself) {
  const Camera pinhole = Camera::Pinhole(300, 300, 159.5, 119.5, 320, 240);
  const Camera covering = PinholeCovering(pinhole);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(covering.intrinsics()[i], pinhole.intrinsics()[i], 1e-9);
}

TEST(MapPixel, ThereAndBack) {
  const Camera lens = BarrelLens(), pinhole = PinholeCovering(lens);
  for (double y = 0; y < 240; y += 7) {
    for (double x = 0; x < 320; x += 9) {
      const auto there = MapPixel(pinhole, lens, {x, y});
      ASSERT_TRUE(there);
      const auto back = MapPixel(lens, pinhole, *there);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - Eigen::Vector2d(x, y)).norm(), 1e-9);
    }
  }
}

TEST(Reproject, SmoothLightReturnsInThePinholeFrame) {
  const Camera lens = BarrelLens(), pinhole = PinholeCovering(lens);
  const Raster image = Reproject(PhotoOfLight(lens), lens, pinhole);
  int seen = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Vector3d sight = pinhole.Unproject(Eigen::Vector2d(x, y));
      const auto source = lens.Project(sight);
      const bool inside = (source->array() > 1).all() && source->x() < 318 && source->y() < 238;
      if (inside) {
        ASSERT_LT((image.Rgb(x, y) - Light(sight)).norm(), 2e-5) << x << ", " << y;
        ++seen;
      } else if (!lens.Sees(*source)) {
        ASSERT_EQ(image.Rgb(x, y), Eigen::Vector3d::Zero());
      }
    }
  }
  EXPECT_GT(seen, 320 * 240 * 0.85);
}

TEST(Reproject, ThereAndBackIsThePhotograph) {
  const Camera lens = BarrelLens(), pinhole = PinholeCovering(lens);
  const Raster photo = PhotoOfLight(lens);
  const Raster back = Reproject(Reproject(photo, lens, pinhole), pinhole, lens);
  for (int y = 4; y < photo.height - 4; ++y) {
    for (int x = 4; x < photo.width - 4; ++x) {
      ASSERT_LT((back.Rgb(x, y) - photo.Rgb(x, y)).norm(), 1e-4);
    }
  }
}

TEST(Reproject, OntoItselfChangesNothing) {
  const Camera pinhole = Camera::Pinhole(300, 300, 159.5, 119.5, 320, 240);
  const Raster photo = PhotoOfLight(pinhole);
  const Raster same = Reproject(photo, pinhole, pinhole);
  for (size_t i = 0; i < photo.data.size(); ++i) ASSERT_NEAR(same.data[i], photo.data[i], 1e-6);
}

TEST(Reproject, LightIsNeverNegative) {
  const Camera lens = BarrelLens();
  Raster photo(lens.width(), lens.height());
  for (int y = 0; y < photo.height; ++y) photo.SetRgb(160, y, {50, 50, 50});
  const Raster image = Reproject(photo, lens, PinholeCovering(lens));
  for (const float value : image.data) ASSERT_GE(value, 0);
}

TEST(Reproject, RefusesAnImageOfAnotherSize) {
  EXPECT_THROW(Reproject(Raster(10, 10), BarrelLens(), BarrelLens()), CheckError);
}

}  // namespace
}  // namespace insitu
