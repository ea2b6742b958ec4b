// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a least-squares adjustment at its solution. The Jacobian's rows are observations
// divided by their sigma, its columns unknowns.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace insitu {

using Jacobian = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Inverse of J^T J, through its sparse factor; nullopt on a rank defect.
std::optional<Eigen::MatrixXd> Cofactor(const Jacobian& jacobian);

// The unknowns that take part in the directions which no observation determines.
std::vector<int> UndeterminedColumns(const Jacobian& jacobian);

// r_i = 1 - J_i Q J_i^T, the share of an error of observation i that its residual shows, 0..1.
Eigen::VectorXd RedundancyNumbers(const Jacobian& jacobian, const Eigen::MatrixXd& cofactor);

// Two-sided probability of a weighted square sum at least as unusual as `square_sum`; 1 without
// redundancy.
double ChiSquareTwoSided(double square_sum, int redundancy);

}  // namespace insitu
