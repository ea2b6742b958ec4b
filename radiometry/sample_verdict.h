// SPDX-License-Identifier: GPL-3.0-or-later
// What is to be objected to in the samples of a measurement of light: their materials, what they
// contradict, the exposure of their photographs.
#pragma once

#include <vector>

#include "calibration/program/finding.h"
#include "radiometry/light_measurement.h"

namespace insitu {

void JudgeSamples(const LightMeasurement& measured, std::vector<Finding>* findings);

}  // namespace insitu
