// SPDX-License-Identifier: GPL-3.0-or-later
// What it means for the surveyor that a network cannot be solved, at the line of the survey
// concerned.
#pragma once

#include "calibration/files/sentence.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/network_system.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Names the parameters that nothing determines, and what would.
SaidError RankDefectError(const RankDefect& defect, const SurveyNetwork& survey_network,
                          const Survey& survey);

// An observation that has no value at the start values: almost always a mark whose point would lie
// behind the camera.
SaidError NoSolutionError(const NoSolution& failure, const Network& network, const Survey& survey);

}  // namespace insitu
