// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "radiometry/spectrum/color.h"
#include "radiometry/spectrum/color_temperature.h"

namespace insitu {
namespace {

constexpr double kSunTemperature = 5778;  // [K]: within 4 % of its spectrum, bin by bin
constexpr double kOzone = 0.3;            // [atm cm]
constexpr double kAngstrom = 1.14;        // exponent of the aerosol's wavelength
constexpr double kUpwardAirMass = 1.8;    // of what the ground sends back

// Transmittances along an air mass at one wavelength, and what the aerosol scatters forward.
struct Passage {
  double rayleigh = 1, aerosol = 1, aerosol_scattering = 1, aerosol_absorption = 1, ozone = 1;
};

Passage PassageOf(double nm, double air_mass, double pressure, double depth) {
  const double um = nm / 1000;
  const double rayleigh = 1 / (std::pow(um, 4) * (115.6406 - 1.335 / (um * um)));
  const double aerosol = depth * std::pow(um / 0.5, -kAngstrom);
  const double albedo = 0.945 * std::exp(-0.095 * std::pow(std::log(um / 0.4), 2));
  const double chappuis = 0.125 * std::exp(-std::pow((um - 0.6) / 0.055, 2));  // [1/(atm cm)]
  return {std::exp(-air_mass * pressure * rayleigh), std::exp(-air_mass * aerosol),
          std::exp(-air_mass * albedo * aerosol), std::exp(-air_mass * (1 - albedo) * aerosol),
          std::exp(-air_mass * chappuis * kOzone)};
}

// The share of what aerosols scatter that goes on downwards, for their asymmetry of 0.65.
double ForwardShare(double cosine) {
  const double a = std::log(1 - 0.65);
  const double first = a * (1.459 + a * (0.1595 + a * 0.4129));
  const double second = a * (0.0783 + a * (-0.3824 - a * 0.5874));
  return 1 - 0.5 * std::exp((first + second * cosine) * cosine);
}

// [Kasten 1966]
double AirMass(double elevation) {
  const double degrees = elevation * 180 / std::numbers::pi;
  return 1 / (std::sin(elevation) + 0.15 * std::pow(3.885 + degrees, -1.253));
}

// What the sky throws back of what comes up to it.
double SkyAlbedo(const Passage& upward) {
  return upward.ozone * upward.aerosol_absorption *
         (0.5 * (1 - upward.rayleigh) + (1 - ForwardShare(1 / kUpwardAirMass)) * upward.rayleigh *
                                            (1 - upward.aerosol_scattering));
}

}  // namespace

ClearSky ClearSkyOf(const ClearSkyInput& input, const SpectralBins& bins) {
  INSITU_CHECK(input.sun_elevation > 0 && input.aerosol_depth >= 0);
  const double cosine = std::sin(input.sun_elevation);
  const double pressure = std::pow(1 - 2.25577e-5 * std::clamp(input.altitude, -400.0, 9000.0),
                                   5.25588);  // standard atmosphere, over that at sea level
  const Spectrum sun = BlackBody(kSunTemperature, bins);
  ClearSky sky;
  for (int i = 0; i < bins.count; ++i) {
    const Passage down =
        PassageOf(bins.Center(i), AirMass(input.sun_elevation), pressure, input.aerosol_depth);
    const Passage up = PassageOf(bins.Center(i), kUpwardAirMass, pressure, input.aerosol_depth);
    sky.sun_normal[i] = sun[i] * down.rayleigh * down.aerosol * down.ozone;
    const double level = sun[i] * cosine * down.ozone * down.aerosol_absorption;
    const double scattered = level * (0.5 * (1 - std::pow(down.rayleigh, 0.95)) +
                                      std::pow(down.rayleigh, 1.5) * (1 - down.aerosol_scattering) *
                                          ForwardShare(cosine));
    const double back = SkyAlbedo(up) * input.ground_albedo;
    sky.sky_level[i] = scattered + (sky.sun_normal[i] * cosine + scattered) * back / (1 - back);
    if (bins.Center(i) <= 450) sky.sky_level[i] *= std::pow(bins.Center(i) / 1000 + 0.55, 1.8);
  }
  return sky;
}

double SunToSky(const Spectrum& sun_normal, const Spectrum& sky_level, double sun_elevation,
                const SpectralBins& bins) {
  return WeightOfD65(sun_normal, bins) * std::sin(sun_elevation) / WeightOfD65(sky_level, bins);
}

}  // namespace insitu
