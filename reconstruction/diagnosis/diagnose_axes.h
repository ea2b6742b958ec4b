// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of all coordinates at once.
#pragma once

#include <cstddef>
#include <vector>

#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

// Of all control or all marks: axes exchanged, mirrored, in another unit. `bad` are the photos
// (indices) that do not fit.
std::vector<Diagnosis> DiagnoseAxes(const DiagnosisInput& input, const std::vector<size_t>& bad);

}  // namespace insitu
