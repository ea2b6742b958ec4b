// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a least-squares adjustment at its solution. The Jacobian's rows are observations
// divided by their sigma, its columns unknowns.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "reconstruction/network/selected_inverse.h"

namespace insitu {

using Jacobian = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// J^T J.
Eigen::SparseMatrix<double> NormalMatrix(const Jacobian& jacobian);

// The unknowns that take part in the directions which no observation determines. At least one.
std::vector<int> UndeterminedColumns(const Eigen::SparseMatrix<double>& normal);

// r_i = 1 - J_i Q J_i^T, the share of an error of observation i that its residual shows, 0..1.
// [Baarda, A testing procedure for use in geodetic networks, 1968]
Eigen::VectorXd RedundancyNumbers(const Jacobian& jacobian, const SelectedInverse& cofactor);

// Two-sided probability of a weighted square sum at least as unusual as `square_sum`; 1 without
// redundancy.
double ChiSquareTwoSided(double square_sum, int redundancy);

// The value that a chi-square variable stays below with `probability`.
double ChiSquareQuantile(int degrees, double probability);

// |w| above this is unusual at `significance`, two-sided: 3.29 for 0.1 %.
double CriticalTestValue(double significance);

// delta0: the noncentrality at which such a test finds an error with `power`: 4.13 for 0.1 %, 80 %.
double DetectableNoncentrality(double significance, double power = 0.8);

// Two-sided p of a standard normal variable.
double NormalTwoSided(double value);

}  // namespace insitu
