// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of trace.h with light among surfaces.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/picture/render.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/trace.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const SurfacePoint kLawnOrigin = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};

LightDirections WholeSky(const MontageScene& scene) {
  return {scene.natural.light.sun_direction, 0, 1};
}

SurfaceMaterial Grey(double albedo) {
  return {"grey", Eigen::Vector3d::Constant(albedo), 1, std::nullopt};
}

PrimaryRay Primary(const MontageScene& scene, const Eigen::Vector3d& target) {
  const Eigen::Vector3d origin(0, -10, 3);
  return {{origin, (target - origin).normalized()},
          Eigen::Vector3d::Constant(kLawnRadiance),
          WholeSky(scene)};
}

double Red(const MontageScene& scene, const Spectrum& stimulus) {
  return scene.natural.spectra.RgbFromSpectrum(stimulus).x();
}

// A wall of the site, 40 m wide and 20 m high, in the east: it hides the sun from the origin.
void AddWallInTheEast(SmallSite* site) {
  Polygon wall;
  wall.name = "wall";
  for (const auto& [y, z] : {std::pair(-20, 0), {-20, 20}, {20, 20}, {20, 0}}) {
    wall.vertices.push_back(site->natural.scene.origin + Eigen::Vector3d(6, y, z));
  }
  wall.normal = -Eigen::Vector3d::UnitX();
  wall.photo = 0;
  wall.material = "lawn";
  site->natural.scene.polygons.push_back(wall);
}

TEST(ChangeInBalance, IsTheQuotientOfIrradiances) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {20, 0, 20}, 2, Grey(0.5)));  // hides the sun
  const Spectrum white = scene.natural.spectra.SpectrumFromRgb(Eigen::Vector3d::Ones());
  const Spectrum L0 = 0.2 * white;
  const double E_sun = 2 * std::sqrt(0.5), E_around = 1.2;
  for (const double change : {-0.4, 0.0, 0.3}) {
    const SmoothLight around = {E_around * white, change * white, change != 0};
    const Spectrum L = DiffuseChange(scene, kLawnOrigin, L0, 1, WholeSky(scene), around);
    EXPECT_NEAR(Red(scene, L), 0.2 * (change - E_sun) / (E_sun + E_around), 1e-4) << change;
  }
}

TEST(ChangeInBalance, AddsWhereLightIsAdded) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, -3}, 1, Grey(0.5)));
  const Spectrum white = scene.natural.spectra.SpectrumFromRgb(Eigen::Vector3d::Ones());
  const SmoothLight around = {1.2 * white, 0.3 * white, true};
  const Spectrum L = DiffuseChange(scene, kLawnOrigin, 0.2 * white, 1, WholeSky(scene), around);
  EXPECT_NEAR(Red(scene, L), 0.2 * 0.3 / (2 * std::sqrt(0.5) + 1.2), 1e-4);
  // A photograph too bright for the light that is known reflects no more than all of it.
  const Spectrum bright = DiffuseChange(scene, kLawnOrigin, 9 * white, 1, WholeSky(scene), around);
  EXPECT_NEAR(Red(scene, bright), 0.3 / kPi, 1e-4);
}

TEST(ChangeInBalance, BelowReachIsExactlyNothing) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, -3}, 1, Grey(0.5)));
  const SmoothLight around = {Spectrum::Constant(1), Spectrum::Constant(-1e-4), false};
  const Spectrum L0 = Spectrum::Constant(0.2);
  const Spectrum L = DiffuseChange(scene, kLawnOrigin, L0, 1, WholeSky(scene), around);
  EXPECT_TRUE((L == 0).all());
}

TEST(ChangeInBalance, NeverTakesMoreThanThereIs) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {20, 0, 20}, 2, Grey(0.5)));
  const SmoothLight around = {Spectrum::Constant(0.1), Spectrum::Constant(-0.5), true};
  const Spectrum L0 = Spectrum::Constant(0.2);
  const Spectrum L = DiffuseChange(scene, kLawnOrigin, L0, 1, WholeSky(scene), around);
  EXPECT_TRUE((L == -L0).all());
}

// D3: a change "due to an artificial object only". Where the site itself hides the sun, a building
// before the sun takes nothing; with either light.
TEST(CaseD3, WhatTheSiteShadesABuildingCannotShade) {
  for (const bool is_interreflected : {false, true}) {
    SmallSite site = MakeSmallSite();
    site.natural.light.sky_radiance.setZero();
    site.natural.light.ambient_radiance *= is_interreflected ? 0 : 1;
    const ArtificialEnvironment plate = Plate(site, {20, 0, 20}, 2, Grey(0));
    const auto change = [&](const MontageScene& scene) {
      const std::optional<SmoothLight> around =
          is_interreflected ? std::optional(SmoothLight{Spectrum::Constant(0.5)}) : std::nullopt;
      return DiffuseChange(scene, kLawnOrigin, Spectrum::Constant(0.2), 1, WholeSky(scene), around);
    };
    EXPECT_TRUE((change(site.With(plate)) < 0).all());
    AddWallInTheEast(&site);
    EXPECT_TRUE((change(site.With(plate)) == 0).all()) << is_interreflected;
  }
}

// The sky's share: a lid above what a wall hides takes the rest alone.
TEST(CaseD3, TheSkyThatTheSiteHidesIsNotTakenAgain) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_radiance.setZero();
  AddWallInTheEast(&site);
  const ArtificialEnvironment behind_wall = Plate(site, {30, 0, 15}, 5, Grey(0));
  MontageScene scene = site.With(behind_wall);
  const Spectrum L = DiffuseChange(scene, kLawnOrigin, Spectrum::Constant(0.2), 1, WholeSky(scene));
  EXPECT_TRUE((L == 0).all());
  AddInterreflection(&scene, 0);
  EXPECT_TRUE((scene.interreflected->interreflection.At(kLawnOrigin).change == 0).all());
}

TEST(InterreflectedTrace, OpenPlateReceivesSunAndSky) {
  const SmallSite site = MakeSmallSite();
  MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, Grey(0.4)));
  AddInterreflection(&scene, std::nullopt);
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, 0, 2}));
  ASSERT_TRUE(outcome.hits_building);
  // The open sky is k_h L + k_u L; seen from above, nothing else stands around.
  const double E = 2 * std::sqrt(0.5) + kPi * 0.35;
  EXPECT_NEAR(outcome.rgb.x(), 0.4 / kPi * E, 0.002);
}

TEST(InterreflectedTrace, SoffitIsLitByTheLawnAndNotByAUniformTerm) {
  const SmallSite site = MakeSmallSite();
  MontageScene scene = site.With(Plate(site, {0, 0, 6}, 0.5, Grey(0.4)));
  AddInterreflection(&scene, std::nullopt);
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, 0, 6}));
  ASSERT_TRUE(outcome.hits_building);
  EXPECT_NEAR(outcome.rgb.x(), 0.4 * kLawnRadiance, 0.02 * 0.4 * kLawnRadiance);
}

TEST(InterreflectedTrace, FarLawnIsExactlyUnchanged) {
  const SmallSite site = MakeSmallSite();
  MontageScene scene = site.With(Box(site, {-1, 30, 0}, {1, 31, 2}, Grey(0.4)));
  AddInterreflection(&scene, std::nullopt);
  EXPECT_TRUE(TracePrimary(scene, Primary(scene, {0, -6, 0})).rgb.isZero(0));
  EXPECT_FALSE(TracePrimary(scene, Primary(scene, {0, 29.5, 0})).rgb.isZero(0));
}

TEST(InterreflectedTrace, WithoutABuildingThePhotographStandsBitForBit) {
  SmallSite site = MakeSmallSite();
  for (size_t i = 0; i < site.photo.data.size(); ++i) {
    site.photo.data[i] = 0.1f + 0.0013f * static_cast<float>(i % 211);
  }
  MontageScene scene = site.With({});
  AddInterreflection(&scene, std::nullopt);
  const RenderResult rendered = RenderMontage(scene, site.camera(), site.photo);
  EXPECT_EQ(rendered.linear.data, site.photo.data);
}

}  // namespace
}  // namespace insitu
