// SPDX-License-Identifier: GPL-3.0-or-later
// Point spread and grain of a photograph in the natural environment description.
#pragma once

#include "calibration/files/json_file.h"
#include "radiometry/light/image_quality.h"

namespace insitu {

// "point_spread" and "grain", null where they are not known.
Json::Value ImageQualityToJson(const ImageQuality& quality);

// Throws InputError: a width, variance or correlation that cannot be.
ImageQuality ImageQualityFromJson(const JsonNode& node);

}  // namespace insitu
