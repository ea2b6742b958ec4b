// SPDX-License-Identifier: GPL-3.0-or-later
// Why a survey does not fit: hypotheses about what surveyors mix up, each tested by resecting the
// photos with the input as it would have to be, and told with the figures that speak for it.
#pragma once

#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct Diagnosis {
  enum class Kind {
    kFault,     // the input contradicts itself, and agrees when corrected so
    kMisfit,    // something does not fit, and no correction is known: a gross error
    kQuestion,  // it fits, but is hardly meant so
  };
  FilePlace place;
  std::string message;  // what is wrong, what shows it, what to do
  Kind kind = Kind::kFault;
  std::string unused_control = {};  // the control point, where it is one that nothing refers to
};

// Faults first, then misfits, then questions; the best explanation first; none for a survey that
// fits. `cameras` go with `photos`. Told are
//
// - control: x and y exchanged, an axis counted backwards (left-handed), heights or plan in another
//   unit, two coordinate systems, two rows exchanged, one point far off, the same coordinates
//   twice, coordinates or sigmas in millimetres, degrees instead of metres;
// - marks: x and y exchanged, y counted from the bottom, named as another point, exchanged, far
// off,
//   the same marks on two photos, two photos of one exterior orientation;
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

// "observations.csv:12: message".
std::string Text(const Diagnosis& diagnosis);

}  // namespace insitu
