// SPDX-License-Identifier: GPL-3.0-or-later
// A survey's network, solved from its start values: what all figures of an adjustment come from.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/lens/photo_lens.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SolvedSurvey {
  SurveyNetwork survey_network;
  NetworkSolution solution;
};

// A rank defect, a point behind its camera, with what is to be left out to go on.
struct UnsolvableSurvey : SaidError {
  UnsolvableSurvey(const SaidError& error, std::vector<std::string> points_in,
                   std::string photo_in = "")
      : SaidError(error), points(std::move(points_in)), photo(std::move(photo_in)) {}

  std::vector<std::string> points;  // the survey's points among what is not determined
  std::string photo;  // of the mark that has no value, which is of points[0]; or empty
};

// Throws InputError, at the survey line concerned: what MakeSurveyNetwork refuses, and
// UnsolvableSurvey.
SolvedSurvey SolveSurvey(const Survey& survey, const StartValues& start,
                         const std::vector<PhotoLens>& lenses, const AdjustmentOptions& options);

}  // namespace insitu
