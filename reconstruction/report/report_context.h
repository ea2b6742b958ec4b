// SPDX-License-Identifier: GPL-3.0-or-later
// What the residual report says besides the adjustment.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/verdict/camera_context.h"

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

// Everything may be missing, and is then said to be.
struct ReportContext {
  AdjustmentOptions options;
  int start_estimates = 0;  // photos that the user placed
  std::string command;      // with its options, without paths
  std::vector<InputFile> inputs;
  std::map<std::string, std::string> programs;  // version of other programs used, by name
  CameraContexts cameras;
  std::map<std::string, std::string> thumbnails;  // data URIs to draw on, by photo
  std::vector<MontagePoint> montage;
};

}  // namespace insitu
