// SPDX-License-Identifier: GPL-3.0-or-later
// What sun and sky send where no cloud is, to be held against what was measured.
// [Bird, Riordan 1986: Simple solar spectral model for direct and diffuse irradiance on horizontal
// and tilted planes at the earth's surface for cloudless atmospheres, J. Clim. Appl. Meteor. 25]
#pragma once

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

struct ClearSkyInput {
  double sun_elevation = 0;    // [rad], > 0
  double altitude = 0;         // [m], for the pressure
  double aerosol_depth = 0.1;  // optical, at 500 nm: 0.05 clean, 0.1 usual, 0.4 hazy
  double ground_albedo = 0.2;  // what the ground sends back to the sky
};

// In one arbitrary unit; water vapour, which absorbs beyond 690 nm, is left out.
struct ClearSky {
  Spectrum sun_normal = Spectrum::Zero();  // irradiance across the rays
  Spectrum sky_level = Spectrum::Zero();   // irradiance on the level
};
ClearSky ClearSkyOf(const ClearSkyInput& input, const SpectralBins& bins);

// Irradiance of the sun over that of the sky, both on the level, as bright as they look.
double SunToSky(const Spectrum& sun_normal, const Spectrum& sky_level, double sun_elevation,
                const SpectralBins& bins);

}  // namespace insitu
