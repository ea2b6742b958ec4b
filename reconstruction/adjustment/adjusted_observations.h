// SPDX-License-Identifier: GPL-3.0-or-later
// What the surveyor reads of a solved network's observations: each with its test and reliability,
// the datum that they leave free, control points predicted from the rest.
#pragma once

#include <string>
#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {

// By row, with names, test values and reliability. [Baarda 1968]
std::vector<ObservationResidual> AdjustedObservations(const SurveyNetwork& survey_network,
                                                      const NetworkSolution& solution,
                                                      double significance);

// "fixed by the survey", or what is free of position, orientation and scale and how it was fixed.
std::string DatumInWords(const Datum& datum);

// Each control point as the rest of the network predicts it, from its own residuals v and their
// cofactors R: R^-1 v. Those that the rest does not determine are left out.
std::vector<PointComparison> LeaveOneOut(const SurveyNetwork& survey_network,
                                         const NetworkSolution& solution);

}  // namespace insitu
