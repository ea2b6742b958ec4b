// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/algebra/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "calibration/files/error.h"

namespace insitu {

template <int Size>
SymmetricEigen<Size> EigenOfSymmetric(const Eigen::Matrix<double, Size, Size>& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Size, Size>> solver;
  if constexpr (Size == 2) {
    solver.computeDirect(matrix);
  } else {
    solver.compute(matrix);
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template SymmetricEigen<2> EigenOfSymmetric(const Eigen::Matrix2d& matrix);
template SymmetricEigen<3> EigenOfSymmetric(const Eigen::Matrix3d& matrix);
template SymmetricEigen<Eigen::Dynamic> EigenOfSymmetric(const Eigen::MatrixXd& matrix);

Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd InverseOfSymmetric(const Eigen::MatrixXd& a) {
  return a.ldlt().solve(Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

LeastSquaresSolution SolveLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                       std::optional<double> threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(a);
  if (threshold) factor.setThreshold(*threshold);
  return {factor.solve(b), static_cast<int>(factor.rank())};
}

Eigen::VectorXi PivotOrder(const Eigen::MatrixXd& a) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(a).colsPermutation().indices();
}

Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& a) {
  INSITU_CHECK(a.rows() >= a.cols());
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ() *
         Eigen::MatrixXd::Identity(a.rows(), a.cols());
}

SingularValues SingularValuesOf(const Eigen::MatrixXd& a) {
  INSITU_CHECK(a.rows() >= a.cols());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

std::optional<Eigen::MatrixXd> Decorrelation(const Eigen::MatrixXd& covariance) {
  if (!(covariance.diagonal().array() > 0).all()) return std::nullopt;
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * covariance * scale.asDiagonal());
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.matrixL().solve(Eigen::MatrixXd(scale.asDiagonal()));
}

Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace insitu
