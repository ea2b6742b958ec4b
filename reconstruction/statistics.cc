// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/statistics.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace insitu {
namespace {

// Pivots of the normal matrix with unit diagonal below this are rounding, not information.
constexpr double kRankTolerance = 1e-12;

Eigen::VectorXd ColumnScales(const Jacobian& jacobian) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(jacobian.cols());
  for (int row = 0; row < jacobian.rows(); ++row) {
    for (Jacobian::InnerIterator entry(jacobian, row); entry; ++entry) {
      squares[entry.col()] += entry.value() * entry.value();
    }
  }
  return squares.unaryExpr([](double square) { return square > 0 ? 1 / std::sqrt(square) : 1.0; });
}

Eigen::SparseMatrix<double> ScaledNormal(const Jacobian& jacobian, const Eigen::VectorXd& scales) {
  const Eigen::SparseMatrix<double> scaled = jacobian * scales.asDiagonal();
  return scaled.transpose() * scaled;
}

}  // namespace

std::optional<Eigen::MatrixXd> Cofactor(const Jacobian& jacobian) {
  const Eigen::VectorXd scales = ColumnScales(jacobian);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(ScaledNormal(jacobian, scales));
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > kRankTolerance)) {
    return std::nullopt;
  }
  const Eigen::MatrixXd inverse =
      factor.solve(Eigen::MatrixXd::Identity(jacobian.cols(), jacobian.cols()));
  const Eigen::MatrixXd cofactor = scales.asDiagonal() * inverse * scales.asDiagonal();
  return (cofactor + cofactor.transpose()) / 2;
}

std::vector<int> UndeterminedColumns(const Jacobian& jacobian) {
  constexpr double kShare = 0.1;  // of a null direction's largest component
  const Eigen::MatrixXd normal = ScaledNormal(jacobian, ColumnScales(jacobian));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
  Eigen::VectorXd participation = Eigen::VectorXd::Zero(normal.cols());
  for (int k = 0; k < normal.cols(); ++k) {
    if (k > 0 && eigen.eigenvalues()[k] > kRankTolerance) break;
    const Eigen::VectorXd direction = eigen.eigenvectors().col(k).cwiseAbs();
    participation = participation.cwiseMax(direction / direction.maxCoeff());
  }
  std::vector<int> columns;
  for (int column = 0; column < normal.cols(); ++column) {
    if (participation[column] > kShare) columns.push_back(column);
  }
  return columns;
}

Eigen::VectorXd RedundancyNumbers(const Jacobian& jacobian, const Eigen::MatrixXd& cofactor) {
  Eigen::VectorXd redundancy(jacobian.rows());
  for (int row = 0; row < jacobian.rows(); ++row) {
    double explained = 0;
    for (Jacobian::InnerIterator a(jacobian, row); a; ++a) {
      for (Jacobian::InnerIterator b(jacobian, row); b; ++b) {
        explained += a.value() * cofactor(a.col(), b.col()) * b.value();
      }
    }
    redundancy[row] = std::clamp(1 - explained, 0.0, 1.0);
  }
  return redundancy;
}

double ChiSquareTwoSided(double square_sum, int redundancy) {
  if (redundancy <= 0) return 1;
  const double below = boost::math::cdf(boost::math::chi_squared(redundancy), square_sum);
  return 2 * std::min(below, 1 - below);
}

}  // namespace insitu
