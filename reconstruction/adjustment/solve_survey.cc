// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/solve_survey.h"

#include "reconstruction/adjustment/solution_errors.h"

namespace insitu {

SolvedSurvey SolveSurvey(const Survey& survey, const StartValues& start,
                         const std::vector<PhotoLens>& lenses, const AdjustmentOptions& options) {
  SolvedSurvey solved{MakeSurveyNetwork(survey, start, lenses, options), {}};
  Network& network = solved.survey_network.network;
  try {
    solved.solution = SolveNetwork(&network);
    return solved;
  } catch (const NoSolution& failure) {
    throw NoSolutionError(failure, network, survey);
  } catch (const RankDefect& defect) {
    throw RankDefectError(defect, solved.survey_network, survey);
  }
}

}  // namespace insitu
