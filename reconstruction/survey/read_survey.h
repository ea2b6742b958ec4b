// SPDX-License-Identifier: GPL-3.0-or-later
// The survey folder, read whole.
#pragma once

#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Photographs with tie points need no survey at all.
enum class SurveyFolder { kRequired, kOptional };

// Reads the survey folder and resolves every name. Throws InputError at the offending line: a name
// twice, an observation of a photo that is not there, or of a point that no other file names
// and whose name is near to one that does, a pair, edge or constraint of a point that is neither
// surveyed nor marked nor a vertex, a mark outside any sensible frame, sigma <= 0, a polygon with
// fewer than three distinct vertices, an unknown role, kind or key, a pair or edge of one point.
// Unknown names come with the nearest known ones. control_points.csv and
// observations.csv must be there unless `files` says otherwise, the other files may. Points of a
// single mark are left out: lone_marks. tie_points stays empty: reconstruct_site.h sets it.
Survey ReadSurvey(const SitePaths& site, const std::vector<std::string>& photos,
                  SurveyFolder files = SurveyFolder::kRequired);

// A survey that is still being made.
struct SurveySoFar {
  Survey survey;  // without files at fault, and without constraints of what they hold
  std::vector<Sentence> faults;  // one for each of these
};

// As ReadSurvey, but no file needs to be there, a name needs not mean anything yet, and all
// marks are observations. Throws
// nothing for the content of a file.
SurveySoFar ReadSurveySoFar(const SitePaths& site, const std::vector<std::string>& photos);

}  // namespace insitu
