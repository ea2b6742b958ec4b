// SPDX-License-Identifier: GPL-3.0-or-later
// Which photograph shows a polygon best: a proposal for its image attribute.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

struct PhotoOfPolygon {
  size_t photo = 0;      // index into `cameras`
  double score = 0;      // pixels per metre along the more foreshortened side
  double angle = 0;      // [rad], between the line of sight and the polygon's normal, 0..pi/2
  double mm_per_px = 0;  // across the line of sight, at the polygon's middle
};

// The photographs that hold all vertices in their frames, best first. `vertices` are
// counter-clockwise from outside: photos that look at the back are left out, unless all do, as
// those of an outline whose sense is not settled yet. What stands before it is not asked.
std::vector<PhotoOfPolygon> RankPhotosOf(const std::vector<PosedCamera>& cameras,
                                         const std::vector<Eigen::Vector3d>& vertices);

}  // namespace insitu
