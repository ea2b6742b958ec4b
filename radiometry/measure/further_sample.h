// SPDX-License-Identifier: GPL-3.0-or-later
// Which sample more would tell most, by what it would take from the variances.
#pragma once

#include <optional>
#include <vector>

#include "calibration/files/sentence.h"
#include "radiometry/measure/fit_atmosphere.h"
#include "radiometry/measure/fit_daylight.h"

namespace insitu {

// Whether this factor remains of a standard deviation, it is worth the way.
inline constexpr double kWorthASample = 0.9;

struct FurtherDaylightSample {
  Sentence where;       // "in full sun, facing it"
  double sun_left = 1;  // of the standard deviations of sun and sky, what would be left, 0..1
  double sky_left = 1;
};

// Of full sun, the open and the deep shade, the one after which sun and sky are known best beside
// what they send. nullopt: none is worth it, or the samples tell nothing yet. `brdf` as
// FitDaylight's; a new sample is taken to be as good as the median of those that there are.
std::optional<FurtherDaylightSample> BestFurtherSample(const std::vector<DaylightSample>& samples,
                                                       const DaylightFit& fit, const Spectrum& brdf,
                                                       bool has_sun, const SpectralBins& bins);

struct FurtherHazeSample {
  double distance = 0;  // [m]
  double left = 1;      // of the transmittance's standard deviation, 0..1
};

// The distance, of those up to twice the farthest, at which one sample more of the same material
// tells most. nullopt: none is worth it, or there is no haze to tell.
std::optional<FurtherHazeSample> BestFurtherSample(const std::vector<HazeSample>& samples,
                                                   const AtmosphereFit& fit,
                                                   const SpectralBins& bins);

}  // namespace insitu
