// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows tell without any photo.
#pragma once

#include <vector>

#include "reconstruction/diagnosis/diagnosis.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// From the rows alone, without any photo: two coordinate systems, degrees, the same coordinates
// under two names, the same marks on two photos, points of a single mark that were left out.
std::vector<Diagnosis> DiagnoseRows(const Survey& survey);

}  // namespace insitu
