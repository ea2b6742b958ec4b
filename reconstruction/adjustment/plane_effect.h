// SPDX-License-Identifier: GPL-3.0-or-later
// What the planes do to the result: the same network solved without them.
#pragma once

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {

// Solves the network again without its planes and the angles of planes. `solution` is the one with
// them. The difference of two nested least-squares solutions has the cofactor
// Q_without - Q_with, and the planes' share of the weighted squares is chi-square distributed.
PlaneEffect FindPlaneEffect(const SurveyNetwork& survey_network, const NetworkSolution& solution);

}  // namespace insitu
