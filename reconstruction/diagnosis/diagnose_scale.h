// SPDX-License-Identifier: GPL-3.0-or-later
// Photos fit control of any scale: what else tells that its unit is wrong.
#pragma once

#include <vector>

#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

// Of photos that fit: against measured distances and what is plausible.
std::vector<Diagnosis> DiagnoseScale(const DiagnosisInput& input,
                                     const std::vector<ControlFit>& fits);

}  // namespace insitu
