// SPDX-License-Identifier: GPL-3.0-or-later
// What the surveyor reads of a solved network's unknowns: their names, values and covariances.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {

std::vector<AdjustedCamera> AdjustedCameras(const Network& network,
                                            const NetworkSolution& solution);
std::vector<AdjustedPose> AdjustedPoses(const Network& network, const NetworkSolution& solution);

// By photo: of its left rotation increment [rad], centre [m] and all intrinsics of its lens if that
// is adjusted or considered. What is fixed has variance 0.
std::vector<Eigen::MatrixXd> CameraCovariances(const Network& network,
                                               const NetworkSolution& solution);

std::vector<AdjustedPoint> AdjustedPoints(const Network& network, const NetworkSolution& solution);
std::vector<AdjustedPlane> AdjustedPlanes(const SurveyNetwork& survey_network,
                                          const NetworkSolution& solution);

// Largest first.
std::vector<Correlation> HighCorrelations(const Network& network, const NetworkSolution& solution);

// The columns of an unknown in words: "photo IMG_1 center x".
std::vector<std::string> ColumnNames(const Network& network, const Unknown& unknown);

}  // namespace insitu
