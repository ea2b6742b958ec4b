// SPDX-License-Identifier: GPL-3.0-or-later
// First inversion of the illumination model: sun, ambient and sky from one material in varied
// light. [Durisch92, §4.3]
#pragma once

#include <optional>
#include <vector>

#include "radiometry/light/daylight.h"

namespace insitu {

struct DaylightSample {
  Spectrum true_color;     // L_0i, radiance, haze removed
  Spectrum sigma;          // its standard deviation, > 0 in used bins
  LightGeometry geometry;  // what the point sees of the daylight
  // Irradiance from the surroundings as photographed (Interreflection::At); with all samples or
  // with none.
  std::optional<Spectrum> surroundings = std::nullopt;
  // Mean radiance of what it sees of the sky over the open sky's (GatheredLight::relative_sky).
  Spectrum relative_sky = Spectrum::Ones();
};

// The open sky as the photographs show it, as bright for level ground as a uniform one.
struct SkyObservation {
  Spectrum radiance, sigma;  // > 0 in used bins
};

struct DaylightFitOptions {
  bool average_over_wavelength = false;  // the paper's one spectrum for all three components
  // The inversion as printed: unweighted least squares that may come out negative, and for each
  // component the plain mean of k over the bins; without `surroundings` and `sky`.
  bool as_printed = false;
  std::optional<Spectrum> relative_spectrum = std::nullopt;  // that one; nullopt: D65
  std::optional<SkyObservation> sky = std::nullopt;          // counts with `surroundings` alone
};

struct DaylightFit {
  Spectrum sun_radiance, ambient_radiance, sky_radiance;  // >= 0
  Spectrum sun_sigma, ambient_sigma, sky_sigma;
  double condition = 0;            // of the scaled design matrix, 1 = best
  double rms = 0;                  // of the residuals over their sigma
  std::vector<double> residuals;   // one a sample: (measured - model) / measured, bins averaged
  std::vector<double> over_sigma;  // one a sample: its RMS over the bins, in units of sigma
  // The same of the photographed sky, fitted minus observed; nullopt: it did not count.
  std::optional<double> sky_over_sigma = std::nullopt;
};

// Solves [Durisch92, Eq. (9)] per bin by non-negative weighted least squares for the radiances
// k_s L, k_u L, k_h L. `brdf` is rho of the samples' material [1/sr], > 0 in used bins.
// `has_sun` false (overcast): the sun stays zero. Components without influence on any sample stay
// zero. Samples that contradict the others count less (robust_weights.h). Needs as many samples as
// components (INSITU_CHECK). rms and residuals are those of the solution per wavelength.
//
// The photographed sky is one more observation of the sky's radiance: against its own sigma, while
// the samples' are multiplied by their residuals' size, for texture is more than noise. Five sigmas
// off it counts less, too.
//
// Departure: weights are kept per wavelength unless averaging is asked for; one spectrum for sun
// and sky cannot make bluish shadows.
// Departure: Eq. (4) gives every point the same ambient light, but a sunlit wall faces sunlit
// ground and a shaded one does not, so the sun would take its share. With `surroundings`, which the
// photographs show in the samples' own unit, sun and sky are the only unknowns: nothing is left for
// a uniform light to soak up. Handed on in the terms of Eqs. (4) and (5): k_u L is the mean
// radiance of the surroundings, and k_h L what the sky sends beyond that, for E = sky s + around
// (pi - s) = (sky - around) s + around pi.
DaylightFit FitDaylight(const std::vector<DaylightSample>& samples, const Spectrum& brdf,
                        bool has_sun, const SpectralBins& bins,
                        const DaylightFitOptions& options = {});

}  // namespace insitu
