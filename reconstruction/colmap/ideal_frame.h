// SPDX-License-Identifier: GPL-3.0-or-later
// A pinhole frame without distortion that stands in for a lens COLMAP does not know.
#pragma once

#include <Eigen/Core>

#include "calibration/lens/camera.h"

namespace insitu {

// Its focal length is the lens's on its axis; it covers all that the photograph shows within 80
// degrees of the axis, and its principal point.
Camera IdealFrame(const Camera& camera);

// Where the ideal frame shows what the photograph shows at a pixel. Sights beyond 80 degrees from
// the axis are taken at 80 degrees, so that every keypoint keeps its number.
Eigen::Vector2d IdealFromPixel(const Camera& ideal, const Camera& camera,
                               const Eigen::Vector2d& pixel);

}  // namespace insitu
