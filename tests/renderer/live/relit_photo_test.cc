// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/relit_photo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/light/illumination.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRoofHeight = 20;  // [m], of a roof over the east, whose shadow begins at x = 0
constexpr double kPenumbra = 0.3;   // [m], half its width with room to spare

// The small site's lawn, its eastern half in the shadow of a roof, in haze, without light from the
// sky (which the roof would hide by parts): all radiances have closed forms.
class RelitPhotoTest : public testing::Test {
 protected:
  RelitPhotoTest() {
    Polygon roof = Scene().polygons[0];
    roof.name = "roof";
    roof.vertices.clear();
    for (const auto& [x, y] : {std::pair(20, -90), {90, -90}, {90, 90}, {20, 90}}) {
      roof.vertices.push_back(Scene().origin + Eigen::Vector3d(x, y, kRoofHeight));
    }
    Scene().polygons.push_back(roof);
    Light().sky_radiance.setZero();
    site_.natural.air.transmittance = Spectrum::Constant(0.999) * site_.natural.spectra.Ones() +
                                      (1 - site_.natural.spectra.Ones());
    PaintPhoto();
  }

  SceneGeometry& Scene() { return site_.natural.scene; }
  Daylight& Light() { return site_.natural.light; }

  // Where a pixel's ray meets the lawn, local; nullopt: on the roof or in the sky.
  std::optional<Eigen::Vector3d> OnLawn(int x, int y) const {
    const PosedCamera& camera = site_.camera();
    const Rigid3 world_from_cam = Inverse(camera.cam_from_world);
    const Eigen::Vector3d from = world_from_cam.translation - site_.natural.scene.origin;
    const Eigen::Vector3d to =
        world_from_cam.rotation * camera.camera.Unproject(Eigen::Vector2d(x, y));
    if (to.z() >= 0) return std::nullopt;
    const Eigen::Vector3d at = from - from.z() / to.z() * to;
    return at.head<2>().cwiseAbs().maxCoeff() < 80 ? std::optional(at) : std::nullopt;
  }

  double DistanceOf(const Eigen::Vector3d& point) const {
    return (Center(site_.camera().cam_from_world) - site_.natural.scene.origin - point).norm();
  }

  Eigen::Vector3d Seen(const Spectrum& irradiance, const Eigen::Vector3d& point) const {
    return site_.natural.spectra.RgbFromSpectrum(ApparentColor(
        ReflectedRadiance(1, brdf_, irradiance), site_.natural.air, DistanceOf(point)));
  }
  Spectrum Sun() const { return Daylit().sun_radiance * Daylit().sun_solid_angle / std::sqrt(2.); }
  Spectrum Ambient() const { return kPi * Daylit().ambient_radiance; }
  const Daylight& Daylit() const { return site_.natural.light; }

  void PaintPhoto() {
    for (int y = 0; y < site_.photo.height; ++y) {
      for (int x = 0; x < site_.photo.width; ++x) {
        const auto point = OnLawn(x, y);
        if (!point) continue;
        site_.photo.SetRgb(x, y, Seen(point->x() > 0 ? Ambient() : Sun() + Ambient(), *point));
      }
    }
  }

  // Calls test(x, y, point) for pixels of the lawn beside the penumbra.
  template <typename Test>
  void ForLawn(const Test& test) const {
    int shaded = 0, sunlit = 0;
    for (int y = 0; y < site_.photo.height; ++y) {
      for (int x = 0; x < site_.photo.width; ++x) {
        const auto point = OnLawn(x, y);
        if (!point || std::abs(point->x()) < kPenumbra) continue;
        ++(point->x() > 0 ? shaded : sunlit);
        test(x, y, *point);
      }
    }
    EXPECT_GT(shaded, 500);
    EXPECT_GT(sunlit, 500);
  }

  SmallSite site_ = MakeSmallSite();
  Spectrum brdf_ = Spectrum::LinSpaced(0.2, 0.1) / kPi;
};

TEST_F(RelitPhotoTest, WithoutTheSunBothHalvesAreAlike) {
  const auto relit = RelightPhoto(site_.natural, 0, site_.photo);
  ForLawn([&](int x, int y, const Eigen::Vector3d& point) {
    const Eigen::Vector3d expected = Seen(Ambient(), point);
    EXPECT_LT((relit->without_sun.Rgb(x, y) - expected).norm(), 0.01 * expected.norm())
        << x << " " << y;
    EXPECT_TRUE(relit->is_relit[y * site_.photo.width + x]);
  });
}

TEST_F(RelitPhotoTest, InTheSunAloneTheShadowIsBlackBehindItsHaze) {
  const auto relit = RelightPhoto(site_.natural, 0, site_.photo);
  ForLawn([&](int x, int y, const Eigen::Vector3d& point) {
    const Eigen::Vector3d expected = Seen(point.x() > 0 ? 0 * Sun() : Sun(), point);
    EXPECT_LT((relit->sun_alone.Rgb(x, y) - expected).norm(), 0.01 * Seen(Sun(), point).norm());
  });
}

TEST_F(RelitPhotoTest, AWrongWeightOfTheSunLeavesTheShadow) {
  for (const double factor : {0.8, 1.25}) {
    NaturalEnvironment wrong = site_.natural;
    wrong.light.sun_radiance *= factor;
    const auto relit = RelightPhoto(wrong, 0, site_.photo);
    ForLawn([&](int x, int y, const Eigen::Vector3d& point) {
      if (point.x() > 0 || DistanceOf(point) > 20) return;
      EXPECT_GT(std::abs(relit->without_sun.Rgb(x, y)[1] / Seen(Ambient(), point)[1] - 1), 0.05);
    });
  }
}

TEST_F(RelitPhotoTest, HalfTheSizeShowsTheSamePlaces) {
  Raster half(site_.photo.width / 2, site_.photo.height / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) half.SetRgb(x, y, site_.photo.Rgb(2 * x, 2 * y));
  }
  const auto whole = RelightPhoto(site_.natural, 0, site_.photo);
  const auto small = RelightPhoto(site_.natural, 0, half);
  for (int y = 1; y < half.height; ++y) {  // corners of the lawn and the roof fall between pixels
    for (int x = 0; x < half.width; ++x) {
      if (!OnLawn(2 * x, 2 * y - 1)) continue;
      EXPECT_TRUE(small->is_relit[y * half.width + x]) << x << " " << y;
      EXPECT_EQ(whole->is_relit[2 * y * site_.photo.width + 2 * x], true);
    }
  }
}

TEST_F(RelitPhotoTest, WhatIsOnNoPolygonOrMirrorsKeepsItsColour) {
  site_.photo.SetRgb(0, 0, {0.1, 0.2, 0.3});  // sky
  site_.natural.materials["lawn"].specular = Specular{0.5, 1.33};
  const auto relit = RelightPhoto(site_.natural, 0, site_.photo);
  EXPECT_EQ(relit->without_sun.data, site_.photo.data);
  EXPECT_EQ(relit->sun_alone.data, site_.photo.data);
  EXPECT_FALSE(relit->is_relit[0]);
}

TEST_F(RelitPhotoTest, EndsWhenItIsNotWantedAnyMore) {
  EXPECT_FALSE(RelightPhoto(site_.natural, 0, site_.photo, [] { return true; }));
}

}  // namespace
}  // namespace insitu
