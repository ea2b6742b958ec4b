// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry of a network, whatever its residuals: rays, angles, base, control, calibrated
// region, coverage.
#pragma once

#include <vector>

#include "reconstruction/report/verdict.h"

namespace insitu {

// Appends to `findings`.
void JudgeGeometry(const Adjustment& adjustment, const ReportContext& context,
                   std::vector<Finding>* findings);

}  // namespace insitu
