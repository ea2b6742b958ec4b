// SPDX-License-Identifier: GPL-3.0-or-later
// Why a survey does not fit: hypotheses about what surveyors mix up, each tested by resecting the
// photos with the input as it would have to be, and told with the figures that speak for it.
#pragma once

#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/lens/camera.h"
#include "reconstruction/diagnosis/diagnosis.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Faults first, then misfits, then questions; the best explanation first; none for a survey that
// fits. `cameras` go with `photos`. Told are
//
// - control: x and y exchanged, an axis counted backwards (left-handed), heights or plan in another
//   unit, two coordinate systems, two rows exchanged, one point far off, the same coordinates
//   twice, coordinates or sigmas in millimetres, degrees instead of metres;
// - marks: x and y exchanged, y counted from the bottom, named as another point, exchanged, far
// off,
//   the same marks on two photos, two photos of one exterior orientation, points left out for
//   their single mark;
// - camera positions and distances in another unit or system than the control, or exchanged.
//
// Photos with fewer than four control points (five, to find single faults) are not judged.
std::vector<Diagnosis> Diagnose(const Survey& survey, const std::vector<std::string>& photos,
                                const std::vector<Camera>& cameras);

// Throws the first fault as InputError; returns misfits and questions, for the report's warnings.
std::vector<Diagnosis> RequireSound(const Survey& survey, const std::vector<std::string>& photos,
                                    const std::vector<Camera>& cameras);

// To be called where a survey turns out to be unusable: throws the first misfit, which is the
// likely cause, as InputError; else `symptom`.
[[noreturn]] void ThrowDiagnosed(const std::vector<Diagnosis>& diagnoses,
                                 const InputError& symptom);

}  // namespace insitu
