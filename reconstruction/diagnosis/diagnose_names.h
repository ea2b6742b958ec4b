// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of single marks and points, found by what the others agree on.
#pragma once

#include <cstddef>
#include <vector>

#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

// Of single marks and points: exchanged, wrongly named, far off.
std::vector<Diagnosis> DiagnoseNames(const DiagnosisInput& input, const std::vector<size_t>& bad);

}  // namespace insitu
