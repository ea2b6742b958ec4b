// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/simulated_daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

constexpr double kClearestAir = 0.02, kHaziestAir = 0.6;  // aerosol depths

double ElevationOf(const Eigen::Vector3d& sun, const Eigen::Vector3d& zenith) {
  return std::asin(std::clamp(sun.dot(zenith), -1.0, 1.0));
}

// The depth by which the model has the measured sun over sky, or the nearest end: the hazier the
// air, the less sun and the more sky.
double AerosolDepthOf(const Daylight& measured, ClearSkyInput input, const SpectralBins& bins) {
  const Spectrum sky = std::numbers::pi * (measured.sky_radiance + measured.ambient_radiance);
  const Spectrum sun = measured.sun_radiance * measured.sun_solid_angle;
  const double found = SunToSky(sun, sky, input.sun_elevation, bins);
  double low = kClearestAir, high = kHaziestAir;
  for (int i = 0; i < 40; ++i) {
    input.aerosol_depth = (low + high) / 2;
    const ClearSky by_model = ClearSkyOf(input, bins);
    const double ratio =
        SunToSky(by_model.sun_normal, by_model.sky_level, input.sun_elevation, bins);
    (ratio > found ? low : high) = input.aerosol_depth;
  }
  return (low + high) / 2;
}

// Bins that are not in use stay as they are.
Spectrum RatioOf(const Spectrum& after, const Spectrum& before, const SpectralBins& bins) {
  Spectrum ratio = Spectrum::Ones();
  for (int i = 0; i < bins.count; ++i) {
    if (before[i] > 0) ratio[i] = after[i] / before[i];
  }
  return ratio;
}

Spectrum OnLevel(const Daylight& light, double elevation) {
  return light.sun_radiance * light.sun_solid_angle * std::sin(elevation) +
         std::numbers::pi * (light.sky_radiance + light.ambient_radiance);
}

}  // namespace

std::optional<SimulatedDaylight> DaylightUnder(const Daylight& measured, const Eigen::Vector3d& sun,
                                               double altitude, const SpectralBins& bins) {
  const double before = ElevationOf(measured.sun_direction, measured.zenith_direction),
               after = ElevationOf(sun, measured.zenith_direction);
  const bool has_sun = (measured.sun_radiance > 0).any() && measured.sun_solid_angle > 0;
  if (!has_sun || before < kLowestSimulatedSun || after < kLowestSimulatedSun) return std::nullopt;
  SimulatedDaylight simulated{.light = measured};
  ClearSkyInput input{.sun_elevation = before, .altitude = altitude};
  input.aerosol_depth = simulated.aerosol_depth = AerosolDepthOf(measured, input, bins);
  const ClearSky then = ClearSkyOf(input, bins);
  input.sun_elevation = after;
  const ClearSky now = ClearSkyOf(input, bins);
  simulated.sun_ratio = RatioOf(now.sun_normal, then.sun_normal, bins);
  simulated.sky_ratio = RatioOf(now.sky_level, then.sky_level, bins);
  Daylight& light = simulated.light;
  light.sun_direction = sun;
  light.sun_radiance *= simulated.sun_ratio;
  light.sky_radiance *= simulated.sky_ratio;
  light.ambient_radiance *= simulated.sky_ratio;
  if (light.photographed_sky) *light.photographed_sky *= simulated.sky_ratio;
  simulated.level_ratio = RatioOf(OnLevel(light, after), OnLevel(measured, before), bins);
  return simulated;
}

}  // namespace insitu
