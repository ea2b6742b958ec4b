// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/hours/relit_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/light/illumination.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;

// A lawn in haze under a sun in the east, with a wall to its north that keeps a low sun from there
// away; the sky is dark, so that radiances have closed forms.
class RelitImage : public testing::Test {
 protected:
  RelitImage() {
    Daylight& light = site_.natural.light;
    light.ambient_radiance = light.sky_radiance + light.ambient_radiance;
    light.sky_radiance.setZero();
    site_.natural.air.transmittance = Spectrum::Constant(0.999) * site_.natural.spectra.Ones() +
                                      (1 - site_.natural.spectra.Ones());
    simulated_.light = light;
  }

  const Daylight& Measured() const { return site_.natural.light; }
  Raster Relit() const {
    return Relighting(site_.natural, simulated_).Relit(site_.camera(), site_.photo);
  }
  // On the lawn before the camera.
  static constexpr int kX = 32, kY = 40;

  Spectrum LawnLight(const Daylight& light) const {
    return light.sun_radiance * light.sun_solid_angle *
           std::max(0.0, light.sun_direction.dot(light.zenith_direction));
  }

  SmallSite site_ = MakeSmallSite();
  SimulatedDaylight simulated_;
};

TEST_F(RelitImage, UnderTheSameLightIsTheImage) {
  const Raster relit = Relit();
  for (size_t i = 0; i < relit.data.size(); ++i) {
    ASSERT_NEAR(relit.data[i], site_.photo.data[i], 2e-6) << i;
  }
}

TEST_F(RelitImage, LevelGroundGoesWithItsIrradiance) {
  simulated_.light.sun_radiance *= 0.5;
  simulated_.light.sun_direction = Eigen::Vector3d(-0.6, 0, 0.8);
  const Spectrum before = LawnLight(Measured()) + kPi * Measured().ambient_radiance,
                 after = LawnLight(simulated_.light) + kPi * Measured().ambient_radiance;
  const Ray sight = {Center(site_.camera().cam_from_world) - site_.natural.scene.origin,
                     Inverse(site_.camera().cam_from_world).rotation *
                         site_.camera().camera.Unproject({kX, kY}).normalized()};
  const double distance = -sight.origin.z() / sight.direction.z();
  const Spectrum apparent = site_.natural.spectra.SpectrumFromRgb(site_.photo.Rgb(kX, kY));
  const Spectrum expected =
      ApparentColor(TrueColor(apparent, site_.natural.air, distance) * (after / before.max(1e-300)),
                    site_.natural.air, distance);
  const Eigen::Vector3d rgb = site_.natural.spectra.RgbFromSpectrum(expected);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(Relit().Rgb(kX, kY)[c], rgb[c], 1e-6);
}

// Whoever errs by a dark photograph under much light, or a bright one under little, makes no lamp.
TEST_F(RelitImage, NothingSendsBackMoreThanItReceives) {
  simulated_.light.sun_radiance *= 1000;
  const Spectrum most = (LawnLight(simulated_.light) + kPi * Measured().ambient_radiance) / kPi;
  const Eigen::Vector3d white = site_.natural.spectra.RgbFromSpectrum(most);
  site_.photo.SetRgb(kX, kY, {50, 50, 50});
  EXPECT_LE(Relit().Rgb(kX, kY).maxCoeff(), 1.01 * std::max(50.0, white.maxCoeff()));
}

TEST_F(RelitImage, TheSkyGoesWithTheSky) {
  simulated_.light.ambient_radiance *= 0.25;
  ASSERT_GT(
      (Inverse(site_.camera().cam_from_world).rotation * site_.camera().camera.Unproject({kX, 0}))
          .z(),
      0);
  const Eigen::Vector3d before = site_.photo.Rgb(kX, 0), after = Relit().Rgb(kX, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], 0.25 * before[c], 1e-6);
}

TEST_F(RelitImage, AWallsShadowFallsWhereTheSunPutsIt) {
  Polygon wall = site_.natural.scene.polygons[0];
  wall.name = "wall";
  wall.vertices.clear();
  for (const auto& [y, z] : {std::pair(-50, 0), {50, 0}, {50, 30}, {-50, 30}}) {
    wall.vertices.push_back(site_.natural.scene.origin + Eigen::Vector3d(-15, y, z));
  }
  wall.normal = Eigen::Vector3d::UnitX();
  site_.natural.scene.polygons.push_back(wall);
  const double lit = Relit().Rgb(kX, kY).sum();
  simulated_.light.sun_direction = Eigen::Vector3d(-0.8, 0, 0.6);  // behind the wall
  EXPECT_LT(Relit().Rgb(kX, kY).sum(), 0.9 * lit);
  simulated_.light.sun_direction = Eigen::Vector3d(0.8, 0, 0.6);
  EXPECT_GT(Relit().Rgb(kX, kY).sum(), 0.8 * lit);
}

}  // namespace
}  // namespace insitu
