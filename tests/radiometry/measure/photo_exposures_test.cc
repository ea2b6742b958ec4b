// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/photo_exposures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace insitu {
namespace {

constexpr int kWidth = 300, kHeight = 200;  // [px]
const Eigen::Vector3d kOrigin(2600500, 1200300, 430);

PosedCamera CameraAt(const std::string& photo, const Eigen::Vector3d& local) {
  Eigen::Matrix3d cam_from_world;  // x to the right, y down, z along the world's y
  cam_from_world << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Quaterniond rotation(cam_from_world);
  return {photo,
          Camera::Pinhole(250, 250, 149.5, 99.5, kWidth, kHeight),
          {rotation, -(rotation * (kOrigin + local))}};
}

Polygon Level(const std::string& name, double x, double y, double half) {
  Polygon polygon;
  polygon.name = name;
  for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    polygon.vertices.push_back(kOrigin + Eigen::Vector3d(x + half * u, y + half * v, 0));
  }
  polygon.normal = Eigen::Vector3d::UnitZ();
  return polygon;
}

// Three photographs of one mottled ground, with noise.
class PhotoExposuresTest : public testing::Test {
 protected:
  PhotoExposuresTest() {
    scene_.origin = kOrigin;
    scene_.cameras = {CameraAt("a", {-4, -20, 5}), CameraAt("b", {0, -16, 6}),
                      CameraAt("c", {5, -22, 4})};
    scene_.polygons = {Level("ground", 0, 0, 60)};
    scene_.zenith = {Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
    for (int i = 0; i < 3; ++i) photos_.push_back(Paint(i));
  }

  Photograph Paint(int index) const {
    const PosedCamera& posed = scene_.cameras[index];
    std::mt19937 random(index);
    std::normal_distribution<double> noise(1, 0.03);
    Photograph photo;
    photo.linear = Raster(kWidth, kHeight);
    photo.encoding = Encoding::kSrgb8;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto point = PointOnPolygon(posed, Eigen::Vector2d(x, y), scene_.polygons[0]);
        if (!point) continue;
        const Eigen::Vector3d local = *point - kOrigin;
        const double mottled = 0.2 + 0.05 * std::sin(local.x()) * std::cos(0.7 * local.y());
        photo.linear.SetRgb(x, y, mottled * noise(random) * Eigen::Vector3d(0.8, 1, 0.5));
      }
    }
    return photo;
  }

  void Scale(int index, const Eigen::Vector3d& gain) {
    for (size_t i = 0; i < photos_[index].linear.data.size(); ++i) {
      photos_[index].linear.data[i] *= static_cast<float>(gain[static_cast<int>(i % 3)]);
    }
  }

  ExposureFit Measure() const { return MeasureExposures(scene_, photos_, exif_, {false}); }

  SceneGeometry scene_;
  std::vector<Photograph> photos_;
  std::vector<ExifExposure> exif_;
};

TEST_F(PhotoExposuresTest, OfOneExposureAllGainsAreExactlyOne) {
  for (const PhotoExposure& photo : Measure().photos) {
    EXPECT_TRUE(photo.IsOne()) << photo.measured << " +- " << photo.sigma;
    EXPECT_GT(photo.points, 500);
    EXPECT_FALSE(photo.by_exif);
  }
}

TEST_F(PhotoExposuresTest, OneStopUpAndDownIsFoundToTwoPercent) {
  Scale(0, Eigen::Vector3d::Constant(2));
  Scale(2, Eigen::Vector3d::Constant(0.5));
  const ExposureFit fit = Measure();
  EXPECT_NEAR(fit.photos[0].gain.y() / 2, 1, 0.02);
  EXPECT_TRUE(fit.photos[1].IsOne());
  EXPECT_NEAR(fit.photos[2].gain.y() / 0.5, 1, 0.02);
  for (const PhotoExposure& photo : fit.photos) EXPECT_LT(photo.sigma, 0.02);
  EXPECT_EQ(fit.photos[0].gain.x(), fit.photos[0].gain.z());  // the colours are alike
}

TEST_F(PhotoExposuresTest, AnotherWhiteBalanceIsAppliedByChannel) {
  Scale(2, {1.2, 1, 0.8});
  const PhotoExposure photo = Measure().photos[2];
  EXPECT_NEAR(photo.gain.x(), 1.2, 0.02);
  EXPECT_NEAR(photo.gain.y(), 1, 0.02);
  EXPECT_NEAR(photo.gain.z(), 0.8, 0.02);
}

TEST_F(PhotoExposuresTest, WhatExifSaysIsHeldAgainstIt) {
  Scale(0, Eigen::Vector3d::Constant(2));
  exif_ = {{0.01, 8, 100}, {0.01, 8, 100}, {0.01, 8, 100}};  // brightened afterwards
  const ExposureFit fit = Measure();
  EXPECT_NEAR(fit.photos[0].measured, 2, 0.04);
  EXPECT_NEAR(*fit.photos[0].by_exif / *fit.photos[1].by_exif, 1, 1e-9);
}

TEST_F(PhotoExposuresTest, WithoutSharedSurfacesExifAloneTells) {
  scene_.polygons = {Level("far", 0, 5000, 1)};
  exif_ = {{0.02, 8, 100}, {0.01, 8, 100}, {0.01, 8, 50}};
  const ExposureFit fit = Measure();
  EXPECT_EQ(fit.photos[0].points, 0);
  EXPECT_NEAR(fit.photos[0].gain.y(), 2, 0.01);
  EXPECT_NEAR(fit.photos[2].gain.y(), 0.5, 0.005);
  EXPECT_FALSE(fit.corner_falloff);
  exif_.clear();
  EXPECT_TRUE(Measure().photos[0].IsOne());
}

TEST_F(PhotoExposuresTest, VignettingOfAllIsTold) {
  for (Photograph& photo : photos_) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Eigen::Vector2d from(x - 149.5, y - 99.5);
        const double left =
            std::exp(-0.4 * from.squaredNorm() / Eigen::Vector2d(149.5, 99.5).squaredNorm());
        photo.linear.SetRgb(x, y, left * photo.linear.Rgb(x, y));
      }
    }
  }
  const ExposureFit fit = Measure();
  ASSERT_TRUE(fit.corner_falloff);
  EXPECT_NEAR(*fit.corner_falloff, -0.4, 0.05);
  EXPECT_LT(fit.corner_falloff_sigma, 0.1);
}

TEST_F(PhotoExposuresTest, MirroringSurfacesTellNothing) {
  EXPECT_EQ(MeasureExposures(scene_, photos_, {}, {true}).photos[0].points, 0);
}

TEST(DivideByGain, DividesEachChannel) {
  Raster picture(1, 1);
  picture.SetRgb(0, 0, {1, 2, 3});
  DivideByGain({2, 4, 0.5}, &picture);
  EXPECT_EQ(picture.Rgb(0, 0), Eigen::Vector3d(0.5, 0.5, 6));
}

}  // namespace
}  // namespace insitu
