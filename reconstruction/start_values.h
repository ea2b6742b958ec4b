// SPDX-License-Identifier: GPL-3.0-or-later
// Start values for the joint adjustment: every photo resected, every point found from control, from
// sights, or from the planes of its polygons.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "reconstruction/adjustment.h"

namespace insitu {

struct StartPoint {
  Eigen::Vector3d position;  // [m], world
  double sigma = 0;  // [m], its largest; infinite if a polygon's plane was needed to find it
};

struct StartValues {
  std::vector<PosedCamera> cameras;  // as `photos`
  std::map<std::string, StartPoint> points;
  std::vector<std::string> warnings;
};

// The points are those that are marked, or a polygon's vertex, or an end of a direction pair.
// Throws InputError as Adjust does: a mark off its photograph, a photo that cannot be resected, a
// point that nothing determines.
StartValues FindStartValues(const Survey& survey, const std::vector<std::string>& photos,
                            const std::vector<Camera>& cameras, const AdjustmentOptions& options);

}  // namespace insitu
