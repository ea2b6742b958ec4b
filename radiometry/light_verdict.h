// SPDX-License-Identifier: GPL-3.0-or-later
// What is to be objected to in a measurement of light, and what the surveyor can do about it.
#pragma once

#include <vector>

#include "calibration/program/finding.h"
#include "radiometry/light_measurement.h"

namespace insitu {

// The worst first; empty: nothing to object to. What would spoil the montage is a fail: a surveyed
// sun that the samples do not show, samples of several materials, of mirroring ones or of different
// exposures, surroundings brighter than they can be, residuals far beyond their sigma.
std::vector<Finding> JudgeLight(const LightMeasurement& measured);

// The sky's open radiance by wavelength, k_h L + k_u L.
Spectrum OpenSky(const NaturalEnvironment& environment);

// Relative luminance, 1 of white in the photographs.
double Luminance(const Spectrum& light, const NaturalEnvironment& environment);

// How high the sun stands [rad]; nullopt: none was surveyed, or it is below the horizon.
std::optional<double> SunElevation(const SceneGeometry& scene);

}  // namespace insitu
