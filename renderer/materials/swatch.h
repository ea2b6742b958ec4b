// SPDX-License-Identifier: GPL-3.0-or-later
// What a material looks like: a sphere and a wall of it in daylight.
#pragma once

#include "calibration/photo/raster.h"
#include "radiometry/light/daylight.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// Daylight on a swatch: the sun stands before it on the left, above it a uniform sky, below it
// level ground that reflects a fifth.
struct SwatchLight {
  double sun_height = 0;                       // [rad]
  Spectrum sun_irradiance = Spectrum::Zero();  // across its rays
  Spectrum sky_radiance = Spectrum::Zero();    // > 0
};

// CIE D65 from a sun 40 degrees high, four fifths of the light, and from the sky.
SwatchLight D65Light(const SpectralBins& bins);
// That of a site; a sun that was not measured stays dark.
SwatchLight LightOf(const Daylight& daylight);

// The sphere in the left half, in the right one the wall; linear Rec. 709, 1 for a white wall.
// Clear materials show a chequered board of grey and white behind them. Light that falls from one
// to the other is left out.
Raster MakeSwatch(const SurfaceMaterial& material, const SwatchLight& light,
                  const SpectralBasis& spectra, int height = 96);

}  // namespace insitu
