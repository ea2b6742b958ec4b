// SPDX-License-Identifier: GPL-3.0-or-later
// What the residual report says besides the adjustment.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "reconstruction/adjustment/adjustment_options.h"

namespace insitu {

struct InputFile {
  std::string name;    // its path below the site folder
  std::string sha256;  // hexadecimal
};

// A point of the montage, such as a planned building's corner; not part of the adjustment.
struct MontagePoint {
  std::string name;
  Eigen::Vector3d position;  // [m], world
};

// What is known of a camera from its calibration.
struct CameraContext {
  std::string model_file;   // its .cameramodel among the inputs
  Json::Value calibration;  // the content of its calibration's report.json, or null
  // The outline within which mrcal calls the lens valid [px]; empty: not known.
  std::vector<Eigen::Vector2d> calibrated_region;
};

// Whether the calibration knows the lens at a pixel: boards were photographed in its cell of the
// frame or, without such a count, mrcal calls it valid there. True if neither is known.
bool IsCalibratedAt(const CameraContext& camera, const Eigen::Vector2d& pixel);

// Everything may be missing, and is then said to be.
struct ReportContext {
  AdjustmentOptions options;
  int start_estimates = 0;  // photos that the user placed
  std::string command;      // with its options, without paths
  std::vector<InputFile> inputs;
  std::map<std::string, std::string> programs;    // version of other programs used, by name
  std::map<int, CameraContext> cameras;           // by index into Adjustment::cameras
  std::map<std::string, std::string> thumbnails;  // data URIs to draw on, by photo
  std::vector<MontagePoint> montage;

  const CameraContext& OfCamera(int camera) const;  // nothing known: an empty one
};

}  // namespace insitu
