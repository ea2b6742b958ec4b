// SPDX-License-Identifier: GPL-3.0-or-later
// What a measurement of haze and daylight tells: people in short, work/environment.json in full.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "radiometry/measure_daylight.h"

namespace insitu {

// Transmittance of white light over a distance [m], linear RGB.
Eigen::Vector3d TransmittanceRgb(const NaturalEnvironment& environment, double distance);

// Irradiance across the sun's rays, k_s L Omega_s.
Eigen::Vector3d SunIrradianceRgb(const NaturalEnvironment& environment);

// What the open sky sends: k_h L + k_u L, for Eq. (4) spreads the ambient light over the sky too.
// Comparable with a measured sky; k_h L alone is what a shaded facet loses.
Eigen::Vector3d OpenSkyRgb(const NaturalEnvironment& environment);

// What was found, without the warnings.
std::string BriefReport(const LightMeasurement& measured);

// What each photograph's linear values are over those of the site's one unit, by channel, as
// WriteEnvironment wrote it: 1 where it is of the same exposure. Throws InputError.
std::vector<Eigen::Vector3d> ReadPhotoGains(const SitePaths& site);

// work/environment.json: the description, and beside it what is for people and for later checks:
// standard deviations, conditions, residuals, RGB of the spectra, inputs, warnings.
void WriteEnvironment(const SitePaths& site, const LightMeasurement& measured);

}  // namespace insitu
