// SPDX-License-Identifier: GPL-3.0-or-later
// Points that no surveyor measured, found in several photographs by image matching, and the first
// exterior orientations that came with them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/rigid3.h"
#include "calibration/program/site.h"

namespace insitu {

struct TiePointMark {
  std::string photo;
  Eigen::Vector2d pixel;  // of the original photograph, distortion and all
};

struct TiePoint {
  Eigen::Vector3d position;         // in the model's frame
  std::vector<TiePointMark> marks;  // two or more photos, one mark each
};

// A model of its own frame and scale until it is aligned with control.
struct TiePoints {
  std::map<std::string, Rigid3> cam_from_model;  // of the photos that could be placed
  std::vector<TiePoint> points;
  double sigma_px = 1;                             // of a mark
  std::string program = {}, program_version = {};  // that matched the photographs; may be unknown
  std::vector<std::string> not_placed = {};        // photos that image matching could not place
  std::vector<std::string> remarks = {};  // what was dropped, merged, left out; for the user
};

// The name of the index-th of TiePoints::points in an adjustment: "tie_000001" of the first.
std::string TiePointName(size_t index);

// Whether a point is named as tie points are: "tie_" and six digits or more.
bool IsTiePointName(const std::string& name);

// site.tie_points(), written whole and with 17 digits.
void WriteTiePoints(const SitePaths& site, const TiePoints& tie_points);

// nullopt: insitu-tie-points has not been run. Throws InputError at the line: a file that is none
// of ours or cut short, a point of fewer than two photos, a mark of a photo that is not placed.
std::optional<TiePoints> ReadTiePoints(const SitePaths& site);

}  // namespace insitu
