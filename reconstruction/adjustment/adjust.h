// SPDX-License-Identifier: GPL-3.0-or-later
// The adjustment of a survey, from its files' content to every figure of the residual report.
// Control is observed with its sigma; check points never.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/lens/photo_lens.h"
#include "calibration/lens/rigid3.h"
#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Resects, intersects, then adjusts. `cameras` and `lenses` go with `photos`; without lenses all
// share one exact camera. `initial_cam_from_world`: a user's estimates, by photo; none is needed.
// Throws InputError, at the survey line concerned: a photo that nothing places, a point that
// nothing determines, a polygon whose vertices are far from planar (over 20 sigma and 0.1 m), a
// rank defect (its parameters named).
Adjustment Adjust(const Survey& survey, const std::vector<std::string>& photos,
                  const std::vector<Camera>& cameras, const AdjustmentOptions& options = {},
                  const std::vector<PhotoLens>& lenses = {},
                  const std::map<std::string, Rigid3>& initial_cam_from_world = {});

}  // namespace insitu
