// SPDX-License-Identifier: GPL-3.0-or-later
// Points that no surveyor measured, found in several photographs by image matching, and the first
// exterior orientations that came with them.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "calibration/rigid3.h"

namespace insitu {

struct TiePointMark {
  std::string photo;
  Eigen::Vector2d pixel;  // of the original photograph, distortion and all
};

struct TiePoint {
  Eigen::Vector3d position;         // in the model's frame
  std::vector<TiePointMark> marks;  // two or more photos
};

// A model of its own frame and scale until it is aligned with control.
struct TiePoints {
  std::map<std::string, Rigid3> cam_from_model;  // of the photos that could be placed
  std::vector<TiePoint> points;
  double sigma_px = 1;  // of a mark
};

}  // namespace insitu
