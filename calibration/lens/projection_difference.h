// SPDX-License-Identifier: GPL-3.0-or-later
// Two lenses compared as mrcal-show-projection-diff does: over the frame and in pixels, since their
// parameters trade off against each other and cannot be compared one by one.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

struct ProjectionDifference {
  int columns = 0, rows = 0;
  // |b's pixel - a's pixel| of the same direction, at the centres of the frame's equal cells, row
  // by row [px]; nullopt where b does not look.
  std::vector<std::optional<double>> px = {};
  Eigen::Quaterniond b_from_a = Eigen::Quaterniond::Identity();  // the implied rotation
  double rms_px = 0, largest_px = 0;                             // over the frame
};

// What both cameras make of a point at infinity, after the rotation between them that calibration
// cannot tell (the camera's axes are its own) is fitted by least squares. `weights`, one a cell,
// say where the fit trusts the lenses; empty: everywhere. Both must have the same size.
ProjectionDifference CompareLenses(const Camera& a, const Camera& b, int columns, int rows,
                                   const std::vector<double>& weights = {});

// The middles of columns x rows equal cells of the frame [px], row by row.
std::vector<Eigen::Vector2d> FrameCenters(int width, int height, int columns, int rows);

}  // namespace insitu
