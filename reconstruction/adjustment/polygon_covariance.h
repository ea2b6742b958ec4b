// SPDX-License-Identifier: GPL-3.0-or-later
// How the vertices of a polygon are known together: the sigma of an edge or an area is no matter of
// its vertices one by one.
#pragma once

#include <vector>

#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {

// By polygon of the survey: 3n x 3n [m^2], of its vertices in their order, scaled by sigma0^2, with
// what the considered lens parameters add. Fixed points have variance 0. Takes one back
// substitution per vertex coordinate.
std::vector<Eigen::MatrixXd> PolygonCovariances(const Survey& survey,
                                                const SurveyNetwork& survey_network,
                                                const NetworkSolution& solution);

}  // namespace insitu
