// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/light_split.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

const SurfacePoint kLawnOrigin = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
const LightDirections kMiddle = {.sun = Eigen::Vector3d::UnitZ()};

LightDirections WholeSky(const MontageScene& scene) {
  return {scene.natural.light.sun_direction, 0, 1};
}

TEST(SplitDaylight, OpenLawnSeesTheWholeSkyAndTheSun) {
  const MontageScene scene = MakeSmallSite().With({});
  const SplitLight light = SplitDaylight(scene, kLawnOrigin, WholeSky(scene), true);
  EXPECT_NEAR(light.natural.sky, std::numbers::pi, 1e-6);
  EXPECT_NEAR(light.natural.sun, std::sqrt(0.5) * kSolarSolidAngle, 1e-12);
  EXPECT_FALSE(light.IsChanged());
}

TEST(SplitDaylight, FourInterleavedRaysTogetherAreTheWholeSky) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {3, 2, 4}, 5, {}));
  const SplitLight whole = SplitDaylight(scene, kLawnOrigin, WholeSky(scene), true);
  double natural = 0, blocked = 0;
  for (int ray = 0; ray < 4; ++ray) {
    const SplitLight part =
        SplitDaylight(scene, kLawnOrigin, ChooseLightDirections(scene, {0.3, 0.6}, ray), true);
    natural += part.natural.sky / 4;
    blocked += part.blocked.sky / 4;
  }
  EXPECT_NEAR(natural, whole.natural.sky, 1e-9);
  EXPECT_NEAR(blocked, whole.blocked.sky, 1e-9);
}

// A large plate close above leaves only the sky near the horizon: form factor of two discs' kind.
TEST(SplitDaylight, PlateBlocksItsFormFactor) {
  SmallSite site = MakeSmallSite();
  site.natural.light.polar_facets = 16;  // 1024 facets: an edge may run between their centres
  const double half = 3.5, height = 3;
  const MontageScene scene = site.With(Plate(site, {0, 0, height + kSurveyClearance}, half, {}));
  const SplitLight light = SplitDaylight(scene, kLawnOrigin, WholeSky(scene), false);
  // Square seen from below its centre, four corner rectangles [Howell, B-4]:
  const double x = half / height, r = std::sqrt(1 + x * x);
  const double form_factor = 4 / std::numbers::pi * (x / r) * std::atan(x / r);
  EXPECT_NEAR(light.blocked.sky / std::numbers::pi, form_factor, 0.02);
  EXPECT_GT(light.blocked.sun, 0);  // 45 degrees up: 3 m aside, 3 m up
  EXPECT_LE(light.blocked.sky, light.natural.sky);
}

TEST(SplitDaylight, FarFromTheBuildingNothingIsTracedOrChanged) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, -5}, 1, {}));  // below the horizon
  const SplitLight light = SplitDaylight(scene, kLawnOrigin, WholeSky(scene), false);
  EXPECT_FALSE(light.IsChanged());
  EXPECT_EQ(light.natural.sky, 0);  // not needed, not computed
}

TEST(ChooseLightDirections, SunStaysOnItsDisc) {
  const MontageScene scene = MakeSmallSite().With({});
  const Eigen::Vector3d center = scene.natural.light.sun_direction;
  double widest = 0;
  for (int i = 0; i < 400; ++i) {
    const int column = i % 20, row = i / 20;
    const Eigen::Vector2d disc((column + 0.5) / 20, (row + 0.5) / 20);
    const LightDirections light = ChooseLightDirections(scene, disc, i);
    widest = std::max(widest, std::acos(std::min(1.0, center.dot(light.sun))));
  }
  EXPECT_LT(widest * 180 / std::numbers::pi, 0.2667);
  EXPECT_GT(widest * 180 / std::numbers::pi, 0.25);
}

TEST(LampIrradiance, FollowsTheInverseSquareAndIsBlocked) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment lamp;
  lamp.lights = {{"lamp", site.natural.scene.origin + Eigen::Vector3d(0, 0, 2 + kSurveyClearance),
                  Eigen::Vector3d::Constant(8)}};
  const MontageScene lit = site.With(lamp);
  const Eigen::Vector3d E =
      lit.natural.spectra.RgbFromSpectrum(LampIrradiance(lit, kLawnOrigin, kMiddle));
  EXPECT_NEAR(E.x(), 2, 1e-9);  // 8 / 2^2
  ArtificialEnvironment shaded = Plate(site, {0, 0, 1}, 1, {});
  shaded.lights = lamp.lights;
  EXPECT_TRUE((LampIrradiance(site.With(shaded), kLawnOrigin, kMiddle) == 0).all());
}

// Below a lamp 2 m up, straight down 8 / 2^2, and nothing where its cone does not reach.
TEST(LampIrradiance, FollowsTheDistribution) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment building;
  PointLight spot{"spot", site.natural.scene.origin + Eigen::Vector3d(0, 0, 2 + kSurveyClearance),
                  Eigen::Vector3d::Constant(8)};
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 1, 0, 0, 0, -1;
  spot.distribution = LightDistribution{axes, {0, 30, 31}, {0}, {0.5, 0.5, 0}};
  building.lights = {spot};
  const MontageScene scene = site.With(building);
  const SurfacePoint below{{0, 0, 0}, {0, 0, 1}}, aside{{3, 0, 0}, {0, 0, 1}};
  EXPECT_NEAR(scene.natural.spectra.RgbFromSpectrum(LampIrradiance(scene, below, kMiddle)).x(), 1,
              1e-9);
  EXPECT_TRUE((LampIrradiance(scene, aside, kMiddle) == 0).all());
}

}  // namespace
}  // namespace insitu
