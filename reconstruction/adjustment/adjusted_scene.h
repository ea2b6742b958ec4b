// SPDX-License-Identifier: GPL-3.0-or-later
// A solved survey as the scene it describes, and against its surveyed points.
#pragma once

#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Fills adjustment->control and adjustment->check from adjustment->points.
void CompareWithSurvey(const Survey& survey, Adjustment* adjustment);

// Of one of the network's directions; without covariance where it is fixed.
Direction AdjustedDirection(const SurveyNetwork& survey_network, const NetworkSolution& solution,
                            int index);

// As the survey's, with the normals of their planes, outward; without covariances.
std::vector<Polygon> AdjustedPolygons(const Survey& survey, const SurveyNetwork& survey_network);

// The whole scene; `adjustment` has its poses and points.
SceneGeometry AdjustedScene(const Survey& survey, const SurveyNetwork& survey_network,
                            const NetworkSolution& solution, const Adjustment& adjustment);

}  // namespace insitu
