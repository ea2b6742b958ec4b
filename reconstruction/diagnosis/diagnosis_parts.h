// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of survey_diagnosis.h, one for each kind of evidence.
#pragma once

#include <string>
#include <vector>

#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/diagnosis/survey_diagnosis.h"

namespace insitu {

struct DiagnosisInput {
  const Survey& survey;
  const std::vector<std::string>& photos;
  const std::vector<Camera>& cameras;
};

// From the rows alone, without any photo: two coordinate systems, degrees, the same coordinates
// under two names, the same marks on two photos.
std::vector<Diagnosis> DiagnoseRows(const Survey& survey);

// Of all control or all marks: axes exchanged, mirrored, in another unit. `bad` are the photos
// (indices) that do not fit.
std::vector<Diagnosis> DiagnoseAxes(const DiagnosisInput& input, const std::vector<size_t>& bad);

// Of single marks and points: exchanged, wrongly named, far off.
std::vector<Diagnosis> DiagnoseNames(const DiagnosisInput& input, const std::vector<size_t>& bad);

// Of photos that fit: against camera positions, measured distances and what is plausible.
std::vector<Diagnosis> DiagnoseScale(const DiagnosisInput& input,
                                     const std::vector<ControlFit>& fits);
std::vector<Diagnosis> DiagnosePositions(const DiagnosisInput& input,
                                         const std::vector<ControlFit>& fits);

// A number as people write it: three significant digits, or two decimals.
std::string Short(double value);

// "'a' and 'b'", "'a', 'b' and 3 others".
std::string ListOf(const std::vector<std::string>& names);

}  // namespace insitu
