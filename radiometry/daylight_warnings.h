// SPDX-License-Identifier: GPL-3.0-or-later
// What a measurement of daylight was short of, while samples are still being chosen too.
#pragma once

#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "radiometry/light_measurement.h"

namespace insitu {

// A condition of the equations above this says that they hardly tell their unknowns apart.
inline constexpr double kPoorCondition = 100;

// Whether any sample of daylight sees the sun.
bool SeesSun(const std::vector<DaylightSample>& samples);

// "IMG_1 (102, 430)"
std::string NameOf(const PixelSample& sample, const SceneGeometry& scene);

// The samples that receive much light from surfaces no photograph shows.
std::vector<std::string> NamesOfUnseen(const LightMeasurement& measured);

std::vector<Sentence> DaylightWarnings(const LightMeasurement& measured);

}  // namespace insitu
