// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of different exposure in the one unit of a site's radiances.
#pragma once

#include "radiometry/light_measurement.h"
#include "radiometry/measure/photograph_set.h"

namespace insitu {

// Measures the exposures of the scene's photographs and divides them, and the samples that were
// read from them, by what they differ by. Where they do not, nothing is touched.
void BringToOneUnit(PhotographSet* photos, LightMeasurement* measured);

}  // namespace insitu
