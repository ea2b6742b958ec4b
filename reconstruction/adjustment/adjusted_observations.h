// SPDX-License-Identifier: GPL-3.0-or-later
// What the surveyor reads of a solved network: every observation with its test and reliability,
// every unknown with its covariance, control and check points.
#pragma once

#include "reconstruction/adjustment/adjustment.h"
#include "reconstruction/adjustment/survey_network.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {

// By row, with names, test values and reliability. [Baarda 1968]
std::vector<ObservationResidual> AdjustedObservations(const SurveyNetwork& survey_network,
                                                      const NetworkSolution& solution,
                                                      double significance);

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

// Of one unknown with another of the same camera, photo or point, above `limit`; largest first.
std::vector<Correlation> HighCorrelations(const Network& network, const NetworkSolution& solution,
                                          double limit = 0.95);

// The columns of an unknown in words: "photo IMG_1 center x".
std::vector<std::string> ColumnNames(const Network& network, const Unknown& unknown);

// "fixed by the survey", or what is free of position, orientation and scale and how it was fixed.
std::string DatumInWords(const Datum& datum);

// Each control point as the rest of the network predicts it, from its own residuals v and their
// cofactors R: R^-1 v. Those that the rest does not determine are left out.
std::vector<PointComparison> LeaveOneOut(const SurveyNetwork& survey_network,
                                         const NetworkSolution& solution);

}  // namespace insitu
