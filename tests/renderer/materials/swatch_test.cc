// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/swatch.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr int kSize = 32;

Raster Swatch(const SurfaceMaterial& material) {
  const SpectralBasis spectra;
  return MakeSwatch(material, D65Light(spectra.bins()), spectra, kSize);
}

Vector3d WallOf(const Raster& swatch) { return swatch.Rgb(kSize + 3, 3); }

TEST(Swatch, AWallHasItsAlbedo) {
  const Vector3d grey(0.5, 0.5, 0.5), brick(0.4, 0.2, 0.1);
  // D65 in bins is not quite the white of Rec. 709.
  EXPECT_NEAR((WallOf(Swatch({.name = "g", .diffuse_rgb = grey})) - grey).norm(), 0, 4e-3);
  EXPECT_NEAR((WallOf(Swatch({.name = "b", .diffuse_rgb = brick})) - brick).norm(), 0, 2e-2);
  SurfaceMaterial half{.name = "h", .diffuse_rgb = grey, .diffuse_weight = 0.5};
  EXPECT_NEAR((WallOf(Swatch(half)) - grey / 2).norm(), 0, 2e-3);
}

TEST(Swatch, TheSunStandsOnTheLeft) {
  const Raster sphere = Swatch({.name = "s", .diffuse_rgb = Vector3d::Constant(0.5)});
  const int middle = kSize / 2;
  EXPECT_GT(sphere.Rgb(middle / 2, middle).y(), 1.5 * sphere.Rgb(middle + middle / 2, middle).y());
}

TEST(Swatch, AMirrorShowsTheSkyAboveAndTheGroundBelow) {
  SurfaceMaterial mirror{.name = "m", .diffuse_weight = 0, .specular = Specular{.weight = 1}};
  mirror.specular_rgb = {1, 0.7, 0.3};
  const Raster sphere = Swatch(mirror);
  const Vector3d sky = sphere.Rgb(kSize / 2, kSize / 8),
                 ground = sphere.Rgb(kSize / 2, 7 * kSize / 8);
  EXPECT_NEAR(sky.z() / sky.x(), 0.3, 0.02);
  EXPECT_NEAR(ground.y() / sky.y(), 1, 0.01);  // a fifth of five times the sky's light
  mirror.specular->roughness.slope = 0.3;
  const Raster rough = Swatch(mirror);
  EXPECT_GT(rough.Rgb(kSize / 3, kSize / 3).y(),
            1.5 * sphere.Rgb(kSize / 3, kSize / 3).y());  // sun
}

TEST(Swatch, OneSeesThroughGlass) {
  SurfaceMaterial pane{.name = "p", .diffuse_rgb = Vector3d::Zero()};
  pane.specular = Specular{.weight = 0, .index = 1.5};
  pane.glass = Glass{.thickness = 0.01, .absorption_rgb = {0, 0, 30}};
  const Raster swatch = Swatch(pane);
  const Vector3d left = swatch.Rgb(kSize + 1, 1), right = swatch.Rgb(kSize + kSize / 8 + 1, 1);
  EXPECT_NEAR(std::max(left.x() / right.x(), right.x() / left.x()), 2, 0.01);  // the board's
  EXPECT_NEAR(left.z() / left.x(), std::exp(-0.3), 0.02);
}

}  // namespace
}  // namespace insitu
