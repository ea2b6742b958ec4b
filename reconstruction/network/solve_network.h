// SPDX-License-Identifier: GPL-3.0-or-later
// The joint least-squares adjustment of a Network, by Ceres, and its statistics from a last pass
// without robust loss.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reconstruction/network/network.h"
#include "reconstruction/network/network_system.h"
#include "reconstruction/network/selected_inverse.h"
#include "reconstruction/network/statistics.h"

namespace insitu {

struct NetworkSolution {
  bool is_converged = false;
  int iterations = 0;

  NetworkColumns columns;
  DatumWorth datum_worth;
  Datum datum;  // where it is free: inner constraints over all points, about the start values
  int observations = 0, unknowns = 0, redundancy = 0;  // redundancy = n - u + datum.defect()
  double square_sum = 0;                               // sum (v / sigma)^2
  double sigma0 = 1;  // a posteriori, a priori 1; 1 without redundancy

  // By row. residual = adjusted - observed, in the unit of sigma.
  std::vector<ObservationRow> rows;
  Eigen::VectorXd residuals, sigmas, redundancy_numbers;

  Jacobian jacobian;         // rows over sigma
  SelectedInverse cofactor;  // of the unknowns, unit weight; covariance = sigma0^2 cofactor
  // Per camera: d unknowns / d considered parameters (count x parameters), else empty.
  std::vector<Eigen::MatrixXd> lens_sensitivity;
};

// Moves the network's unknowns to the least-squares solution.
// Throws RankDefect if the observations do not determine every unknown but for the datum;
// NoSolution.
NetworkSolution SolveNetwork(Network* network);

// Covariance between unknowns of consecutive columns, scaled by sigma0^2, with what the considered
// lens parameters add. Both must occur together in some observation, or be of one unknown.
Eigen::MatrixXd Covariance(const Network& network, const NetworkSolution& solution, int row,
                           int rows, int column, int columns);

// The same of linear functions of any unknowns: one a row, by column.
Eigen::MatrixXd CovarianceOf(const Network& network, const NetworkSolution& solution,
                             const Eigen::MatrixXd& by_unknowns);

}  // namespace insitu
