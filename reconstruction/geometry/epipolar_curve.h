// SPDX-License-Identifier: GPL-3.0-or-later
// Where the point of a mark may lie on another photograph: no straight line through real lenses.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/geometry/lens_view.h"

namespace insitu {

// The image in `other` of everything at any depth that `pixel` of `camera` looks at: pieces within
// the frame, from infinity towards the camera, within `tolerance_px` of the true curve. As a rule
// one; a lens that bends much may cut it at the frame. Empty: the views share nothing of it, or
// both photos were taken from one place.
std::vector<Polyline> EpipolarCurve(const PosedCamera& camera, const Eigen::Vector2d& pixel,
                                    const PosedCamera& other, double tolerance_px = 0.005);

}  // namespace insitu
