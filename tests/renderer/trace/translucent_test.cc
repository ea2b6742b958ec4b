// SPDX-License-Identifier: GPL-3.0-or-later
// Blinds, membranes, leaves: light of one side leaves the other in all directions.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/trace.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kSun = 2 * std::numbers::sqrt2 / 2;  // on the level: E_s = 2 at 45 degrees

SurfaceMaterial Membrane(double albedo, double through) {
  SurfaceMaterial membrane{"membrane", Vector3d::Constant(albedo), 1, std::nullopt};
  membrane.translucent_rgb = Vector3d::Constant(through);
  return membrane;
}

double Seen(const MontageScene& scene, const Vector3d& from, const Vector3d& to) {
  const PrimaryRay primary = {{from, (to - from).normalized()},
                              Vector3d::Constant(kLawnRadiance),
                              {scene.natural.light.sun_direction, 0, 1}};
  return TracePrimary(scene, primary).rgb.x();
}

double Red(const MontageScene& scene, const Spectrum& stimulus) {
  return scene.natural.spectra.RgbFromSpectrum(stimulus).x();
}

TEST(Translucent, UndersideShowsTheSunAndSkyOfItsUpperSide) {
  SmallSite site = MakeSmallSite();
  site.natural.light.ambient_radiance.setZero();
  site.natural.light.polar_facets = 16;
  const MontageScene scene = site.With(Plate(site, {0, 0, 3}, 2, Membrane(0, 0.4)));
  const double sky = kPi * 0.3;
  EXPECT_NEAR(Seen(scene, {0, -4, 1}, {0, 0, 3}), 0.4 / kPi * (kSun + sky), 0.004);
}

TEST(Translucent, ShowsTheLampBehindIt) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_radiance.setZero();
  site.natural.light.sky_radiance.setZero();
  site.natural.light.ambient_radiance.setZero();
  ArtificialEnvironment plate = Plate(site, {0, 0, 3}, 2, Membrane(0, 0.4));
  plate.lights.push_back({.name = "lamp",
                          .position = site.natural.scene.origin + Vector3d(0, 0, 13),
                          .intensity_rgb = Vector3d::Constant(200)});
  EXPECT_NEAR(Seen(site.With(plate), {0, -4, 1}, {0, 0, 3}), 0.4 / kPi * 200 / 100, 2e-3);
}

TEST(Translucent, DisappearsInAFurnaceWhenItKeepsNothing) {
  SmallSite site = MakeSmallSite();
  const Spectrum all = site.natural.spectra.SpectrumFromRgb(Vector3d::Constant(kLawnRadiance));
  site.natural.air.horizon = all;
  site.natural.light.sun_radiance.setZero();
  site.natural.light.sky_radiance = all;
  site.natural.light.ambient_radiance.setZero();
  for (const double through : {0.3, 1.0}) {
    MontageScene scene = site.With(Plate(site, {0, 0, 1}, 3, Membrane(1 - through, through)));
    AddInterreflection(&scene, std::nullopt);
    EXPECT_NEAR(Seen(scene, {0, -10, 6}, {0, 0, 1}) / kLawnRadiance, 1, 0.01) << through;
  }
}

// A membrane over all of the lawn lights it with what it lets through; both send light to and fro.
TEST(Translucent, LightsTheLawnBelowIt) {
  const SmallSite site = MakeSmallSite();
  constexpr double kAlbedo = 0.3, kThrough = 0.5;
  MontageScene scene = site.With(Plate(site, {0, 0, 0.5}, 60, Membrane(kAlbedo, kThrough)));
  AddInterreflection(&scene, std::nullopt);
  const double open = kPi * 0.35 + kSun;  // on its upper side, and on the lawn before
  const double lawn = kPi * kLawnRadiance / open;
  const GatheredLight light =
      scene.interreflected->interreflection.At({Vector3d::Zero(), Vector3d::UnitZ()});
  const double after = Red(scene, light.sky_before + light.surroundings_before + light.change);
  EXPECT_NEAR(after / (kThrough * open / (1 - kAlbedo * lawn)), 1, 0.02);
  // And what of the lawn's light goes up through it is seen from above.
  const double above = (kAlbedo * open + kThrough * lawn * after) / kPi;
  EXPECT_NEAR(Seen(scene, {0, -10, 3}, {0, 0, 0.5}) / above, 1, 0.02);
}

}  // namespace
}  // namespace insitu
