// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/statistics.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "calibration/algebra/decompositions.h"

namespace insitu {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

SparseMatrix WithUnitDiagonal(const SparseMatrix& normal) {
  const Eigen::VectorXd diagonal = normal.diagonal();
  const Eigen::VectorXd scales =
      diagonal.unaryExpr([](double square) { return square > 0 ? 1 / std::sqrt(square) : 1.0; });
  return scales.asDiagonal() * normal * scales.asDiagonal();
}

// Fixed numbers that favour no direction.
Eigen::MatrixXd StartVectors(int rows, int columns) {
  unsigned state = 1;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index, Eigen::Index) {
    state = state * 1664525u + 1013904223u;
    return state / 2147483648.0 - 1;
  });
}

struct SmallestEigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// The `count` smallest, by inverse iteration; `shifted` is the factor of matrix + shift I.
SmallestEigenpairs InverseIteration(const SparseMatrix& matrix,
                                    const Eigen::SimplicialLDLT<SparseMatrix>& shifted, int count) {
  constexpr int kSteps = 4;
  Eigen::MatrixXd basis = StartVectors(static_cast<int>(matrix.rows()), count);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixXd solved = shifted.solve(basis);
    basis = OrthonormalBasis(solved);
  }
  const Eigen::MatrixXd projected = basis.transpose() * (matrix * basis);
  const SymmetricEigen<Eigen::Dynamic> eigen = EigenOfSymmetric(projected);
  return {eigen.values, basis * eigen.vectors};
}

// Eigenvectors of the eigenvalues that are rounding; the smallest one at least.
Eigen::MatrixXd NullDirections(const SparseMatrix& matrix) {
  constexpr double kShift = 1e-11, kRounding = 1e-10;
  SparseMatrix shifted = matrix;
  for (int i = 0; i < matrix.rows(); ++i) shifted.coeffRef(i, i) += kShift;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(shifted);
  const int size = static_cast<int>(matrix.rows());
  for (int count = std::min(8, size);; count = std::min(2 * count, size)) {
    const SmallestEigenpairs smallest = InverseIteration(matrix, factor, count);
    const auto null = static_cast<int>((smallest.values.array() < kRounding).count());
    if (null < count || count == size) return smallest.vectors.leftCols(std::max(null, 1));
  }
}

}  // namespace

SparseMatrix NormalMatrix(const Jacobian& jacobian) {
  const SparseMatrix columns = jacobian;
  return columns.transpose() * columns;
}

std::vector<int> UndeterminedColumns(const SparseMatrix& normal) {
  constexpr double kShare = 0.1;  // of a null direction's largest component
  const Eigen::MatrixXd directions = NullDirections(WithUnitDiagonal(normal)).cwiseAbs();
  Eigen::VectorXd participation = Eigen::VectorXd::Zero(normal.cols());
  for (int k = 0; k < directions.cols(); ++k) {
    participation = participation.cwiseMax(directions.col(k) / directions.col(k).maxCoeff());
  }
  std::vector<int> columns;
  for (int column = 0; column < normal.cols(); ++column) {
    if (participation[column] > kShare) columns.push_back(column);
  }
  return columns;
}

Eigen::VectorXd RedundancyNumbers(const Jacobian& jacobian, const SelectedInverse& cofactor) {
  Eigen::VectorXd redundancy(jacobian.rows());
  std::vector<int> columns, columns_before;
  Eigen::MatrixXd block;
  for (int row = 0; row < jacobian.rows(); ++row) {
    std::swap(columns, columns_before);
    columns.clear();
    std::vector<double> values;
    for (Jacobian::InnerIterator entry(jacobian, row); entry; ++entry) {
      columns.push_back(static_cast<int>(entry.col()));
      values.push_back(entry.value());
    }
    const int count = static_cast<int>(columns.size());
    if (columns != columns_before) {  // both rows of a mark share theirs
      block.resize(count, count);
      for (int i = 0; i < count; ++i) {
        for (int j = 0; j <= i; ++j) {
          block(i, j) = block(j, i) = cofactor.At(columns[i], columns[j]);
        }
      }
    }
    const Eigen::Map<const Eigen::VectorXd> a(values.data(), count);
    redundancy[row] = std::clamp(1 - a.dot(block * a), 0.0, 1.0);
  }
  return redundancy;
}

double ChiSquareTwoSided(double square_sum, int redundancy) {
  if (redundancy <= 0) return 1;
  const boost::math::chi_squared distribution(redundancy);
  const double below = boost::math::cdf(distribution, square_sum);
  const double above = boost::math::cdf(boost::math::complement(distribution, square_sum));
  return 2 * std::min(below, above);
}

double ChiSquareQuantile(int degrees, double probability) {
  return boost::math::quantile(boost::math::chi_squared(degrees), probability);
}

double CriticalTestValue(double significance) {
  return boost::math::quantile(boost::math::complement(boost::math::normal(), significance / 2));
}

double DetectableNoncentrality(double significance, double power) {
  return CriticalTestValue(significance) + boost::math::quantile(boost::math::normal(), power);
}

double NormalTwoSided(double value) {
  return 2 * boost::math::cdf(boost::math::complement(boost::math::normal(), std::abs(value)));
}

}  // namespace insitu
