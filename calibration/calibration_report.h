// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's calibration as JSON, and the page made from that JSON alone.
#pragma once

#include <json/value.h>

#include <string>

#include "calibration/site_calibration.h"

namespace insitu {

Json::Value CalibrationReport(const CameraCalibration& calibration);

// One HTML file without outside references.
std::string CalibrationPage(const Json::Value& report);

}  // namespace insitu
