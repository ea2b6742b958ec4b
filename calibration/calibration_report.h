// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's calibration as JSON, and the page made from that JSON alone.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <optional>
#include <string>

#include "calibration/camera_calibration.h"
#include "calibration/program/site.h"

namespace insitu {

Json::Value CalibrationReport(const CameraCalibration& calibration);

// One HTML file without outside references.
std::string CalibrationPage(const Json::Value& report);

// Covariance of a calibrated camera's intrinsics, in the order of Camera::intrinsics(), from its
// report; nullopt: it brought none (splined models, scans, most camera files).
std::optional<Eigen::MatrixXd> ReadIntrinsicsCovariance(const SitePaths& site,
                                                        const std::string& camera);

}  // namespace insitu
