// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of the cameras besides the adjustment.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace insitu {

// What is known of a camera from its calibration.
struct CameraContext {
  std::string model_file;   // its .cameramodel among the inputs
  Json::Value calibration;  // the content of its calibration's report.json, or null
  // The outline within which mrcal calls the lens valid [px]; empty: not known.
  std::vector<Eigen::Vector2d> calibrated_region;
};

using CameraContexts = std::map<int, CameraContext>;  // by index into Adjustment::cameras

// Nothing known: an empty one.
const CameraContext& ContextOf(const CameraContexts& cameras, int camera);

// Whether the calibration knows the lens at a pixel: boards were photographed in its cell of the
// frame or, without such a count, mrcal calls it valid there. True if neither is known.
bool IsCalibratedAt(const CameraContext& camera, const Eigen::Vector2d& pixel);

}  // namespace insitu
