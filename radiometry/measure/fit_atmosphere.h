// SPDX-License-Identifier: GPL-3.0-or-later
// First inversion of the atmospheric model: the transmittance of the air from one material at
// several distances. [Durisch92, §4.2]
#pragma once

#include <vector>

#include "radiometry/light/atmosphere.h"

namespace insitu {

struct HazeSample {
  Spectrum apparent_color;  // L_i, radiance
  Spectrum sigma;           // its standard deviation, > 0 in used bins
  double distance = 0;      // d_i [m]
};

struct AtmosphereFit {
  Atmosphere air;
  Spectrum true_color = Spectrum::Zero();           // L_0, of the sampled material
  Spectrum transmittance_sigma = Spectrum::Zero();  // per metre
  Spectrum condition = Spectrum::Zero();            // of the normal equations, per bin
  double rms = 0;                                   // of the residuals over their sigma
  std::vector<double> residuals;   // one a sample: mean of (measured - model) / measured over bins
  std::vector<double> over_sigma;  // one a sample: its RMS over the bins, in units of sigma
};

// Solves [Durisch92, Eq. (7)] per bin for tau and L_0 by Gauss-Newton from tau = 1 and the nearest
// sample. Departure: weighted by the samples' sigmas; those that contradict the others count less
// (robust_weights.h); tau is held within (0, 1]. `as_printed`: none of it, and tau may pass 1.
// Needs >= 2 samples at different distances (INSITU_CHECK).
AtmosphereFit FitAtmosphere(const std::vector<HazeSample>& samples, const Spectrum& horizon,
                            const SpectralBins& bins, bool as_printed = false);

}  // namespace insitu
