// SPDX-License-Identifier: GPL-3.0-or-later
// The place before anything is built: lawn, gravel path, gallery, house, two blocks and the light.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "datasets_synthetic/lens.h"
#include "datasets_synthetic/scene.h"

namespace insitu::demo {

using NamedPoint = std::pair<std::string, Eigen::Vector3d>;

// All in the site frame; survey coordinates are origin + site coordinates.
struct Campus {
  Eigen::Vector3d origin;           // [m], survey coordinates of the site frame's origin
  double azimuth = 0;               // [rad], of the plan's x axis about z, from the survey's x axis
  Eigen::Vector3d zenith;           // unit, 0.3 degrees off z
  Eigen::Vector3d sun;              // unit, towards the sun
  Eigen::Vector3d true_north;       // unit
  Scene natural;                    // all that is surveyed
  Scene blockers;                   // the same without lawn and path, which shade nothing
  Scene scenery;                    // far ground and hills: seen, not surveyed, too far to shade
  std::vector<NamedPoint> targets;  // survey targets on the lawn
  std::vector<View> views;
};

// `width`, `height` [px]: size of the photographs.
Campus MakeCampus(int width, int height);

}  // namespace insitu::demo
