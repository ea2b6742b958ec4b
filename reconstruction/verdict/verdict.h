// SPDX-License-Identifier: GPL-3.0-or-later
// What a photogrammetrist would object to in an adjustment, and what the surveyor can do about it.
#pragma once

#include <optional>
#include <vector>

#include "calibration/program/finding.h"
#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/verdict/camera_context.h"

namespace insitu {

// Redundancy numbers below this say that an error would hardly show in the residual.
inline constexpr double kWeaklyControlled = 0.1;

// The worst first; empty: nothing to object to.
std::vector<Finding> Judge(const Adjustment& adjustment, const CameraContexts& cameras = {});

// The observation that data snooping suspects: the largest |w| over the critical value, of what the
// surveyor measured if any, else of tie points. One at a time, since a gross error spoils the
// residuals around it. [Baarda 1968]
std::optional<ObservationResidual> Suspect(const Adjustment& adjustment);

}  // namespace insitu
