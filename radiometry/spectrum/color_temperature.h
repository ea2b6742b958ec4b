// SPDX-License-Identifier: GPL-3.0-or-later
// Light as people name its colour: the temperature of the black body that looks most like it.
#pragma once

#include <optional>

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

struct ColorTemperature {
  double kelvin = 0;  // correlated, by the least distance in CIE 1960 (u, v) [CIE 15]
  double duv = 0;     // that distance, > 0 on the green side
};

// nullopt: no light, a colour farther than 0.05 from every black body's, or bluer than the hottest.
std::optional<ColorTemperature> CorrelatedColorTemperature(const Spectrum& light,
                                                           const SpectralBins& bins);

// Radiance of a black body, 1 at 560 nm. [Planck]
Spectrum BlackBody(double kelvin, const SpectralBins& bins);

}  // namespace insitu
