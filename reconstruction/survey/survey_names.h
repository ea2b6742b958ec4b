// SPDX-License-Identifier: GPL-3.0-or-later
// Who is who in a survey: every name resolved, or told what it was probably meant to be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// The name in `photos` that is the same in Unicode's composed form, else `photo` itself.
std::string SitePhotoName(const std::string& photo, const std::vector<std::string>& photos);

// What is wrong with the name of a photo; nullopt if it is among `photos`.
std::optional<Sentence> FaultOfPhoto(const std::string& photo,
                                     const std::vector<std::string>& photos);

// Marks must be of points that another file names, that an edge or a constraint joins, or that two
// photos show; the ends of pairs, edges and constraints must be surveyed, marked or vertices.
// Throws InputError. A point that a single mark names is no fault, if its name is near to none that
// its photo lacks: somebody is still measuring. LeaveOutLoneMarks finds it.
void RequireKnownPoints(const Survey& survey);

// Moves the marks of such points from the observations to the lone marks.
void LeaveOutLoneMarks(Survey* survey);

// Throws InputError at the first place of a point that is named "tie_" and six digits or more, as
// points of image matching are.
void RequireNoNamesOfTiePoints(const Survey& survey);

}  // namespace insitu
