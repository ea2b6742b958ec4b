// SPDX-License-Identifier: GPL-3.0-or-later
// Start values for the joint adjustment: every photo placed by image matching or resected, every
// point found from control, from sights, or from the planes of its polygons.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/lens/rigid3.h"

namespace insitu {

struct StartPoint {
  Eigen::Vector3d position;  // [m], world
  double sigma = 0;  // [m], its largest; infinite if a polygon's plane was needed to find it
};

// A point of Survey::tie_points, in the world.
struct StartTiePoint {
  struct Mark {
    int photo = 0;  // index into StartValues::cameras
    Eigen::Vector2d pixel;
  };
  std::string name;          // TiePointName of its place in TiePoints::points
  Eigen::Vector3d position;  // [m], world
  std::vector<Mark> marks;   // two or more
};

struct StartValues {
  std::vector<PosedCamera> cameras;  // as `photos`
  std::map<std::string, StartPoint> points;
  std::vector<StartTiePoint> tie_points;
  double tie_point_sigma_px = 1;  // of each of their marks
  std::vector<std::string> warnings;
};

}  // namespace insitu
