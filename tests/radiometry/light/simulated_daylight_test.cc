// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/simulated_daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insitu {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAltitude = 500;  // [m]

Eigen::Vector3d SunAt(double elevation_deg) {
  return {std::cos(elevation_deg * kDegree), 0, std::sin(elevation_deg * kDegree)};
}

// What the model itself says, in a unit of its own.
Daylight ClearDay(double elevation_deg, double depth) {
  const ClearSky sky = ClearSkyOf(
      {.sun_elevation = elevation_deg * kDegree, .altitude = kAltitude, .aerosol_depth = depth},
      {});
  Daylight light;
  light.sun_direction = SunAt(elevation_deg);
  light.sun_radiance = 3 * sky.sun_normal / light.sun_solid_angle;
  light.sky_radiance = 2 * sky.sky_level / std::numbers::pi;
  light.ambient_radiance = 1 * sky.sky_level / std::numbers::pi;
  return light;
}

TEST(DaylightUnder, TheSameSunIsTheSameLight) {
  const Daylight measured = ClearDay(40, 0.1);
  const auto same = DaylightUnder(measured, SunAt(40), kAltitude, {});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->sun_ratio.isApproxToConstant(1, 1e-12));
  EXPECT_TRUE(same->sky_ratio.isApproxToConstant(1, 1e-12));
  EXPECT_TRUE(same->level_ratio.isApproxToConstant(1, 1e-12));
}

TEST(DaylightUnder, AClearDayAtAnotherHourIsTheModelsOwn) {
  const auto evening = DaylightUnder(ClearDay(55, 0.17), SunAt(12), kAltitude, {});
  ASSERT_TRUE(evening);
  EXPECT_NEAR(evening->aerosol_depth, 0.17, 1e-6);
  const Daylight truth = ClearDay(12, 0.17);
  EXPECT_TRUE(evening->light.sun_radiance.isApprox(truth.sun_radiance, 1e-6));
  EXPECT_TRUE(evening->light.sky_radiance.isApprox(truth.sky_radiance, 1e-6));
  EXPECT_TRUE(evening->light.ambient_radiance.isApprox(truth.ambient_radiance, 1e-6));
  EXPECT_EQ(evening->light.sun_direction, SunAt(12));
}

TEST(DaylightUnder, ALowSunIsWeakerAndRedder) {
  const auto evening = DaylightUnder(ClearDay(50, 0.1), SunAt(8), kAltitude, {});
  ASSERT_TRUE(evening);
  EXPECT_LT(evening->sun_ratio.maxCoeff(), 0.8);
  EXPECT_LT(evening->sun_ratio[1], 0.4 * evening->sun_ratio[11]);
  EXPECT_LT(evening->level_ratio.maxCoeff(), 0.4);
}

// Clouds, trees or errors: the air is taken as clean or hazy as air comes, never beyond.
TEST(DaylightUnder, LightThatNoClearSkyHasIsScaledAsTheNearest) {
  Daylight dull = ClearDay(40, 0.3), sharp = dull;
  dull.sun_radiance *= 0.01;
  sharp.sun_radiance *= 100;
  EXPECT_NEAR(DaylightUnder(dull, SunAt(20), kAltitude, {})->aerosol_depth, 0.6, 1e-6);
  EXPECT_NEAR(DaylightUnder(sharp, SunAt(20), kAltitude, {})->aerosol_depth, 0.02, 1e-6);
}

TEST(DaylightUnder, RefusesWhatTheModelDoesNotHold) {
  EXPECT_FALSE(DaylightUnder(ClearDay(40, 0.1), SunAt(2), kAltitude, {}));
  EXPECT_FALSE(DaylightUnder(ClearDay(2.5, 0.1), SunAt(30), kAltitude, {}));
  Daylight overcast = ClearDay(40, 0.1);
  overcast.sun_radiance.setZero();
  EXPECT_FALSE(DaylightUnder(overcast, SunAt(30), kAltitude, {}));
}

}  // namespace
}  // namespace insitu
