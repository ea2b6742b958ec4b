// SPDX-License-Identifier: GPL-3.0-or-later
// Camera positions against the centres that the control points give.
#pragma once

#include <vector>

#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

// Of photos that fit: against camera positions, and against one another.
std::vector<Diagnosis> DiagnosePositions(const DiagnosisInput& input,
                                         const std::vector<ControlFit>& fits);

}  // namespace insitu
