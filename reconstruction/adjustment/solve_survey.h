// SPDX-License-Identifier: GPL-3.0-or-later
// A survey's network, solved from its start values: what all figures of an adjustment come from.
#pragma once

#include <vector>

#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/adjustment/photo_lens.h"
#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SolvedSurvey {
  SurveyNetwork survey_network;
  NetworkSolution solution;
};

// Throws InputError, at the survey line concerned: what MakeSurveyNetwork refuses, a rank defect,
// a point behind its camera.
SolvedSurvey SolveSurvey(const Survey& survey, const StartValues& start,
                         const std::vector<PhotoLens>& lenses, const AdjustmentOptions& options);

}  // namespace insitu
