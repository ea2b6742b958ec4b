// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry of a network, whatever its residuals: rays, angles, base, control, calibrated
// region, coverage.
#pragma once

#include <vector>

#include "calibration/program/finding.h"
#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/verdict/camera_context.h"

namespace insitu {

// Adds to `findings`.
void JudgeGeometry(const Adjustment& adjustment, const CameraContexts& cameras,
                   std::vector<Finding>* findings);

}  // namespace insitu
