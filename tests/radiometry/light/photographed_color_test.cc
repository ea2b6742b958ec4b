// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/photographed_color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu {
namespace {

// A level square and an upright one that hides a part of it from the second camera. The photographs
// tell places by red and green, and themselves by blue.
class PhotographedColorTest : public testing::Test {
 protected:
  PhotographedColorTest() {
    scene_.origin = {2600000, 1200000, 400};
    AddPolygon({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 0);
    AddPolygon({1.5, -3, 0}, {0, 6, 0}, {0, 0, 9}, std::nullopt);
    AddCamera({-9, 2, 14}, 200, 170);
    AddCamera({4, -5, 10}, 180, 210);
    const RayScene rays(MeshOfPolygons(scene_).mesh);
    for (size_t i = 0; i < scene_.cameras.size(); ++i) Paint(rays, i);
  }

  void AddPolygon(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                  std::optional<int> photo) {
    const Eigen::Vector3d a = scene_.origin + corner;
    scene_.polygons.push_back(
        {"polygon", {a, a + u, a + u + v, a + v}, u.cross(v).normalized(), photo, "stone"});
  }

  // Looks down; its x is east, and it sees 8 or 9 m to either side.
  void AddCamera(const Eigen::Vector3d& from, int width, int height) {
    Eigen::Matrix3d down;
    down << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    const Eigen::Quaterniond rotation(down);
    scene_.cameras.push_back({"photo",
                              Camera::Pinhole(150, 150, width / 2.0, height / 2.0, width, height),
                              {rotation, -(rotation * (scene_.origin + from))}});
  }

  void AddPaintedCamera(const Eigen::Vector3d& from, int width, int height) {
    AddCamera(from, width, height);
    Paint(RayScene(MeshOfPolygons(scene_).mesh), scene_.cameras.size() - 1);
  }

  static Eigen::Vector3d ColorAt(const Eigen::Vector3d& local, size_t photo) {
    return {0.4 + 0.01 * local.x(), 0.4 + 0.01 * local.y(),
            0.2 + 0.15 * static_cast<double>(photo)};
  }

  void Paint(const RayScene& rays, size_t index) {
    const PosedCamera& posed = scene_.cameras[index];
    Raster photo(posed.camera.width(), posed.camera.height());
    const Eigen::Vector3d center = Center(posed.cam_from_world) - scene_.origin;
    for (int y = 0; y < photo.height; ++y) {
      for (int x = 0; x < photo.width; ++x) {
        const Eigen::Vector3d sight =
            posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject({x, y});
        const auto hit = rays.Nearest({center, sight});
        if (hit) photo.SetRgb(x, y, ColorAt(center + hit->distance * sight, index));
      }
    }
    photos_.push_back(photo);
  }

  // On the ground.
  std::optional<Eigen::Vector3d> LookUp(double x, double y, double up = 1) const {
    const PolygonMesh polygons = MeshOfPolygons(scene_);
    const RayScene rays(polygons.mesh);
    std::vector<LocalImage> images;
    for (size_t i = 0; i < photos_.size(); ++i) {
      images.emplace_back(scene_.cameras[i], scene_.origin, photos_[i]);
    }
    if (first_is_masked_) {
      images[0].shows = [](int polygon, const Eigen::Vector2d&) { return polygon != 0; };
    }
    const PhotographedSite site = {scene_, rays, polygons.polygon_of_triangle,
                                   images, air_, spectra_};
    const auto color = LookUpColor(site, 0, {{x, y, 0}, {0, 0, up}});
    if (!color) return std::nullopt;
    return spectra_.RgbFromSpectrum(*color);
  }

  void ExpectColor(double x, double y, size_t photo) const {
    const auto color = LookUp(x, y);
    ASSERT_TRUE(color) << x << " " << y;
    EXPECT_LT((*color - ColorAt({x, y, 0}, photo)).norm(), 0.002) << x << " " << y;
  }

  bool first_is_masked_ = false;  // something stands before the level square
  SceneGeometry scene_;
  std::vector<Raster> photos_;
  Atmosphere air_;
  SpectralBasis spectra_;
};

TEST_F(PhotographedColorTest, IsThatOfThePlaceInThePhotographOfTheAttribute) {
  ExpectColor(-12, 4, 0);
  ExpectColor(-1, -3.5, 0);  // which both show
  scene_.polygons[0].photo = 1;
  ExpectColor(-1, -3.5, 1);
  ExpectColor(7, -9, 1);
}

TEST_F(PhotographedColorTest, WhatThatOneDoesNotShowAnotherDoes) {
  ExpectColor(8, -8, 1);  // out of the first one's frame
  scene_.polygons[0].photo = 1;
  ExpectColor(-4, 3, 0);
  EXPECT_FALSE(LookUp(3, 15));
}

TEST_F(PhotographedColorTest, WhereItsMaskHidesThePolygonAnotherIsAsked) {
  ExpectColor(-1, -3.5, 0);
  first_is_masked_ = true;
  ExpectColor(-1, -3.5, 1);
  EXPECT_FALSE(LookUp(-12, 4));  // which the first alone shows
}

TEST_F(PhotographedColorTest, AsPrintedTheAttributeAloneIsAsked) {
  const auto seen = [&](double x, double y, bool by_attribute_alone) {
    const RayScene rays(MeshOfPolygons(scene_).mesh);
    std::vector<LocalImage> images;
    for (size_t i = 0; i < photos_.size(); ++i) {
      images.emplace_back(scene_.cameras[i], scene_.origin, photos_[i]);
    }
    const std::vector<int> polygons = MeshOfPolygons(scene_).polygon_of_triangle;
    return LookUpColors({scene_, rays, polygons, images, air_, spectra_, by_attribute_alone}, 0,
                        {{x, y, 0}, Eigen::Vector3d::UnitZ()})
        .size();
  };
  EXPECT_EQ(seen(8, -8, false), 1u);  // out of its photograph's frame, in the other's
  EXPECT_EQ(seen(8, -8, true), 0u);
  EXPECT_EQ(seen(-12, 4, true), 1u);
  scene_.polygons[0].photo = std::nullopt;
  EXPECT_EQ(seen(8, -8, true), 1u);
}

TEST_F(PhotographedColorTest, WhatStandsBeforeItHidesIt) {
  scene_.polygons[0].photo = 1;
  ExpectColor(0, 0, 0);  // which the first one shows
  EXPECT_FALSE(LookUp(1.2, 0));
}

// Cameras that look straight down have as many pixels on a square metre everywhere: (f / height)^2.
TEST_F(PhotographedColorTest, WithoutAnAttributeThoseCountThatResolveItBest) {
  scene_.polygons[0].photo = std::nullopt;
  const Eigen::Vector2d place(-1, -3.5);
  const auto blue = [&] { return (*LookUp(place.x(), place.y()))[2]; };
  const double low = std::pow(150 / 10.0, 2), high = std::pow(150 / 14.0, 2);
  EXPECT_NEAR(blue(), (0.2 * high + 0.35 * low) / (high + low), 0.002);
  // The fourth tells from where on others count, a fifth nothing.
  AddPaintedCamera({0, 0, 30}, 300, 300);
  AddPaintedCamera({0, 0, 20}, 300, 300);
  const double higher = std::pow(150 / 20.0, 2), least = std::pow(150 / 30.0, 2);
  const double expected = (0.2 * (high - least) + 0.35 * (low - least) + 0.65 * (higher - least)) /
                          (high + low + higher - 3 * least);
  EXPECT_NEAR(blue(), expected, 0.002);
  AddPaintedCamera({0, 0, 40}, 300, 300);
  EXPECT_NEAR(blue(), expected, 0.002);
}

TEST_F(PhotographedColorTest, ThereIsNoSeamAtTheEdgeOfAFrame) {
  const auto blue = [&](double x) { return (*LookUp(x, -3.5))[2]; };
  constexpr double kStep = 0.02;  // [m], a fifth of a pixel of the first one, which ends at x = 0.3
  double last = blue(-1);
  EXPECT_NEAR(last, 0.2, 0.002);
  for (double x = -1 + kStep; x < 0.8; x += kStep) {
    const double here = blue(x);
    EXPECT_LT(std::abs(here - last), 0.01) << x;
    last = here;
  }
  EXPECT_NEAR(last, 0.35, 0.002);
}

TEST_F(PhotographedColorTest, TheOtherSideIsSeenByNone) { EXPECT_FALSE(LookUp(-4, 3, -1)); }

TEST_F(PhotographedColorTest, Eq8_HazeIsTakenOff) {
  air_.transmittance = 0.98 * spectra_.Ones();
  air_.horizon = spectra_.SpectrumFromRgb({0.1, 0.1, 0.1});
  const double tau = std::pow(0.98, std::sqrt(9 + 4 + 14 * 14));  // from above (-12, 4)
  const Eigen::Vector3d apparent = ColorAt({-12, 4, 0}, 0);
  const Eigen::Vector3d expected = (apparent - Eigen::Vector3d::Constant(0.1 * (1 - tau))) / tau;
  EXPECT_LT((*LookUp(-12, 4) - expected).norm(), 0.004);
}

}  // namespace
}  // namespace insitu
