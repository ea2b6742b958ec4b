// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/solve_survey.h"

#include <set>

#include "reconstruction/adjustment/solution_errors.h"

namespace insitu {
namespace {

UnsolvableSurvey ErrorOf(const NoSolution& failure, const Network& network, const Survey& survey) {
  const SaidError error = NoSolutionError(failure, network, survey);
  if (!failure.row || failure.row->kind != ObservationRow::Kind::kMark) return {error, {}};
  const MarkObservation& mark = network.marks[failure.row->index];
  return {error, {network.points[mark.point].name}, network.photos[mark.photo].name};
}

UnsolvableSurvey ErrorOf(const RankDefect& defect, const SurveyNetwork& survey_network,
                         const Survey& survey) {
  std::set<std::string> points;
  for (const RankDefect::Column& column : defect.columns) {
    if (column.unknown.kind != Unknown::Kind::kPoint) continue;
    points.insert(survey_network.network.points[column.unknown.index].name);
  }
  return {RankDefectError(defect, survey_network, survey), {points.begin(), points.end()}};
}

}  // namespace

SolvedSurvey SolveSurvey(const Survey& survey, const StartValues& start,
                         const std::vector<PhotoLens>& lenses, const AdjustmentOptions& options) {
  SolvedSurvey solved{MakeSurveyNetwork(survey, start, lenses, options), {}};
  Network& network = solved.survey_network.network;
  try {
    solved.solution = SolveNetwork(&network);
    return solved;
  } catch (const NoSolution& failure) {
    throw ErrorOf(failure, network, survey);
  } catch (const RankDefect& defect) {
    throw ErrorOf(defect, solved.survey_network, survey);
  }
}

}  // namespace insitu
