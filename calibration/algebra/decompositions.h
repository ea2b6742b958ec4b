// SPDX-License-Identifier: GPL-3.0-or-later
// What is solved and taken apart with dense matrices. Eigen does it; here it is compiled once
// instead of in every room.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace insitu {

// Eigenvalues in ascending order, unit eigenvectors as columns.
template <int Size>
struct SymmetricEigen {
  Eigen::Matrix<double, Size, 1> values;
  Eigen::Matrix<double, Size, Size> vectors;
};

// Of a symmetric matrix, of which the lower triangle is read. Size: 2 (in closed form), 3,
// Eigen::Dynamic.
template <int Size>
SymmetricEigen<Size> EigenOfSymmetric(const Eigen::Matrix<double, Size, Size>& matrix);

// x of a x = b, a symmetric and semi-definite, of which the lower triangle is read (L D L^T). What
// a leaves undetermined is 0.
Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd InverseOfSymmetric(const Eigen::MatrixXd& a);

// The columns of x that minimise |a x - b|, by Householder with pivots. `threshold`: pivots below
// this share of the largest count as 0; the rank is the number of others. Nullopt: rounding alone.
struct LeastSquaresSolution {
  Eigen::MatrixXd x;
  int rank = 0;
};
LeastSquaresSolution SolveLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                       std::optional<double> threshold = std::nullopt);

// The columns of a in the order in which pivoting takes them: those that say most first.
Eigen::VectorXi PivotOrder(const Eigen::MatrixXd& a);

// An orthonormal basis of what the columns of a span; rows >= columns, of full rank.
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& a);

// Singular values in descending order, and right singular vectors as columns; rows >= columns.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
SingularValues SingularValuesOf(const Eigen::MatrixXd& a);

// W with W^T W = covariance^-1, lower triangular: it makes residuals independent, of variance 1.
// Scaled inside, so variables may differ by many powers of ten. Nullopt: not positive definite.
std::optional<Eigen::MatrixXd> Decorrelation(const Eigen::MatrixXd& covariance);

// The least rotation that takes the direction of `from` to that of `to`; of opposite ones, one of
// many.
Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace insitu
