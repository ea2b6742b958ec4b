// SPDX-License-Identifier: GPL-3.0-or-later
// How the sky's radiance is spread, from where photographs show it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "radiometry/light/sky.h"
#include "radiometry/measure/sky_places.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"

namespace insitu {

struct SkyFit {
  SkyShape shape;  // uniform where the photographs support no other
  SkyShape sigma;  // its standard deviations; of a uniform one, those with which it is not another
  // Radiance of a uniform sky as bright for open level ground as what is seen and the shape make
  // it; nullopt: no sky is seen.
  std::optional<Spectrum> level;
  Spectrum level_sigma = Spectrum::Zero();  // of `level`, with what is not seen of the sky's shape
  double rms = 0;                           // of ln radiance about the fit
  int cells = 0;                            // places, 5 degrees apart at least
  double lowest = 0, highest = 0;           // heights above the horizon of what is seen [rad]
};

// Fits ln L = ln L_0 + p G + q H (light/sky.h) per bin by least squares, places that contradict the
// rest counting less (robust_weights.h). p and q are kept where each is beyond three standard
// deviations, changes what is seen by 3 % and is known to 0.3; q only if above zero; both within
// what the CIE's fifteen skies have. `sun` is unit, world; nullopt: overcast, q stays 0. Within
// ten degrees of the sun nothing counts.
SkyFit FitSky(const std::vector<SkyPlace>& places, const Eigen::Vector3d& zenith,
              const std::optional<Eigen::Vector3d>& sun, const SpectralBasis& spectra);

}  // namespace insitu
