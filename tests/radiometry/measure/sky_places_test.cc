// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/sky_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

constexpr int kWidth = 960, kHeight = 640;
const Eigen::Vector3d kSky(0.4, 0.5, 0.6);

// A level ground, a wall that covers the left third, and cameras that look north, or elsewhere.
class SkyPlacesTest : public testing::Test {
 protected:
  SkyPlacesTest() {
    scene_.origin = {2600000, 1200000, 400};
    scene_.zenith.unit = Eigen::Vector3d::UnitZ();
    AddPolygon({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0});
    AddPolygon({-60, 50, 0}, {45, 0, 0}, {0, 0, 60});
    AddCamera(0);
  }

  void AddPolygon(const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                  const Eigen::Vector3d& v) {
    const Eigen::Vector3d a = scene_.origin + corner;
    scene_.polygons.push_back(
        {"polygon", {a, a + u, a + u + v, a + v}, u.cross(v).normalized(), 0, "stone"});
  }

  // Turned to the right of north, with its photograph of sky alone.
  void AddCamera(double azimuth) {
    Eigen::Matrix3d level;  // x right, y down, z north
    level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Quaterniond rotation(level * turn);
    scene_.cameras.push_back(
        {"photo",
         Camera::Pinhole(800, 800, kWidth / 2.0, kHeight / 2.0, kWidth, kHeight),
         {rotation, -(rotation * (scene_.origin + Eigen::Vector3d(0, 0, 2)))}});
    Photograph photo{Raster(kWidth, kHeight), Encoding::kSrgb8};
    photos_.push_back(photo);
    Paint(std::ssize(photos_) - 1, {0, 0}, {kWidth, kHeight}, kSky);
  }

  void Paint(long photo, const Eigen::Vector2i& from, const Eigen::Vector2i& to,
             const Eigen::Vector3d& rgb) {
    for (int y = from.y(); y < to.y(); ++y) {
      for (int x = from.x(); x < to.x(); ++x) photos_[photo].linear.SetRgb(x, y, rgb);
    }
  }

  std::vector<SkyRegion> Regions(const Raster* matte = nullptr) const {
    const RayScene rays(MeshOfPolygons(scene_).mesh);
    PixelSample sample;
    sample.pixel = {700, 60};
    sample.rgb = kSky;
    std::vector<SkyRegion> regions;
    for (size_t i = 0; i < photos_.size(); ++i) {
      for (SkyRegion& region :
           SkyRegionsIn(SkyBlocksOf(photos_[i], scene_.cameras[i].camera, matte),
                        static_cast<int>(i), scene_, rays, {sample})) {
        regions.push_back(std::move(region));
      }
    }
    return regions;
  }

  // Whether some region holds the block about a pixel of the first photograph.
  bool Holds(const std::vector<SkyRegion>& regions, double x, double y) const {
    const PosedCamera& posed = scene_.cameras[0];
    const Eigen::Vector3d direction =
        posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject({x, y});
    return std::ranges::any_of(regions, [&](const SkyRegion& region) {
      return region.photo == 0 && std::ranges::any_of(region.places, [&](const SkyPlace& place) {
               return place.direction.dot(direction) > std::cos(0.009);
             });
    });
  }

  SceneGeometry scene_;
  std::vector<Photograph> photos_;
};

TEST_F(SkyPlacesTest, SkyLiesAboveTheHorizonBesideThePolygons) {
  const std::vector<SkyRegion> regions = Regions();
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_TRUE(regions[0].is_marked);
  EXPECT_TRUE(Holds(regions, 600, 200));
  EXPECT_FALSE(Holds(regions, 100, 200));  // the wall
  EXPECT_FALSE(Holds(regions, 600, 330));  // the ground
  for (const SkyPlace& place : regions[0].places) {
    EXPECT_GT(place.direction.z(), 0.017);
    EXPECT_LT((place.rgb - kSky).norm(), 1e-6);
  }
}

TEST_F(SkyPlacesTest, TreesClippedPixelsAndTheForegroundAreNot) {
  for (int i = 0; i < 200 * 100; ++i) {  // leaves
    const double light = i % 3 == 0 ? 0.9 : 0.1;
    photos_[0].linear.SetRgb(700 + i % 200, 100 + i / 200, kSky * light);
  }
  Paint(0, {400, 20}, {460, 80}, Eigen::Vector3d::Ones());
  Raster matte(kWidth, kHeight, 1);
  for (int y = 220; y < 260; ++y) {
    for (int x = 500; x < 560; ++x) *matte.At(x, y) = 0.3f;
  }
  const std::vector<SkyRegion> regions = Regions(&matte);
  EXPECT_FALSE(Holds(regions, 800, 150));
  EXPECT_FALSE(Holds(regions, 430, 50));
  EXPECT_FALSE(Holds(regions, 530, 240));
  EXPECT_TRUE(Holds(regions, 600, 60));
}

// A smooth house without a polygon is a region of its own, of another colour.
TEST_F(SkyPlacesTest, WhatNoPolygonStandsForIsNotTakenForSky) {
  Paint(0, {500, 150}, {700, 300}, {0.3, 0.25, 0.2});
  const std::vector<SkyRegion> regions = Regions();
  EXPECT_EQ(regions.size(), 2u);
  const std::vector<SkyRegion> sky = SkyAmong(regions);
  ASSERT_EQ(sky.size(), 1u);
  EXPECT_FALSE(Holds(sky, 600, 220));
  EXPECT_TRUE(Holds(sky, 600, 60));
}

TEST_F(SkyPlacesTest, OtherPhotographsSkyIsKnownByItsColour) {
  AddCamera(1.7);
  AddCamera(-1.7);
  Paint(1, {0, 0}, {kWidth, kHeight}, 1.2 * kSky);
  Paint(2, {0, 0}, {kWidth, kHeight}, 0.2 * kSky);  // a wood
  const std::vector<SkyRegion> sky = SkyAmong(Regions());
  ASSERT_EQ(sky.size(), 2u);
  EXPECT_EQ(sky[0].photo, 0);
  EXPECT_EQ(sky[1].photo, 1);
}

TEST_F(SkyPlacesTest, WithoutAMarkedRegionNothingIsSky) {
  std::vector<SkyRegion> regions = Regions();
  for (SkyRegion& region : regions) region.is_marked = false;
  EXPECT_TRUE(SkyAmong(regions).empty());
}

}  // namespace
}  // namespace insitu
