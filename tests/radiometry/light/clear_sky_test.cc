// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/clear_sky.h"

#include <gtest/gtest.h>

#include <numbers>

#include "radiometry/spectrum/color_temperature.h"

namespace insitu {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// NREL's own SPECTRL2, sun across its rays over sky on the level, between its wavelengths.
TEST(ClearSkyOf, AgreesWithSpectrl2) {
  const SpectralBins bins;
  const ClearSky sky = ClearSkyOf({.sun_elevation = 42.0879 * kDegree}, bins);
  const struct {
    double nm, ratio;
  } truth[] = {{442.5, 3.597}, {492.5, 5.069}, {542.5, 6.709}, {592.5, 8.457}, {642.5, 10.23}};
  for (const auto& [nm, ratio] : truth) {
    const int bin = static_cast<int>((nm - kFirstWavelength) / bins.Width());
    EXPECT_NEAR(sky.sun_normal[bin] / sky.sky_level[bin] / ratio, 1, 0.03) << nm;
  }
}

TEST(ClearSkyOf, HazeAndALowSunTakeFromTheSun) {
  const auto ratio = [](double degrees, double depth) {
    const ClearSky sky =
        ClearSkyOf({.sun_elevation = degrees * kDegree, .aerosol_depth = depth}, {});
    return SunToSky(sky.sun_normal, sky.sky_level, degrees * kDegree, {});
  };
  EXPECT_GT(ratio(50, 0.05), ratio(50, 0.1));
  EXPECT_GT(ratio(50, 0.1), 2 * ratio(50, 0.4));
  EXPECT_GT(ratio(50, 0.1), 2 * ratio(15, 0.1));
}

TEST(ClearSkyOf, TheSunIsYellowerThanTheSky) {
  const ClearSky sky = ClearSkyOf({.sun_elevation = 30 * kDegree}, {});
  EXPECT_NEAR(CorrelatedColorTemperature(sky.sun_normal, {})->kelvin, 5000, 400);
  EXPECT_GT(CorrelatedColorTemperature(sky.sky_level, {})->kelvin, 9000);
}

}  // namespace
}  // namespace insitu
