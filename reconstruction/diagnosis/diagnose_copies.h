// SPDX-License-Identifier: GPL-3.0-or-later
// Marks that were measured on another copy of the photograph: resized, cropped, in millimetres of a
// print or as shares of its sides.
#pragma once

#include <vector>

#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

// Faults only. `bad` are the photos whose marks do not fit as they are given. The copy's scale and
// its corner are estimated with the photo's pose, and told if the marks then fit well and a few
// times better than before.
std::vector<Diagnosis> DiagnoseCopies(const DiagnosisInput& input, const std::vector<size_t>& bad);

}  // namespace insitu
