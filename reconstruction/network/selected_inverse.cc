// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/selected_inverse.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// Pivots of the normal matrix with unit diagonal below this are rounding, not information.
constexpr double kRankTolerance = 1e-12;

}  // namespace

std::optional<SelectedInverse> SelectedInverse::Of(const Eigen::SparseMatrix<double>& normal) {
  SelectedInverse inverse;
  const Eigen::VectorXd diagonal = normal.diagonal();
  if (!(diagonal.array() > 0).all() || !diagonal.allFinite()) return std::nullopt;
  inverse.scales_ = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SparseMatrix<double> scaled =
      inverse.scales_.asDiagonal() * normal * inverse.scales_.asDiagonal();
  auto factor = std::make_shared<Factor>(scaled);
  if (factor->info() != Eigen::Success || !(factor->vectorD().minCoeff() > kRankTolerance)) {
    return std::nullopt;
  }
  inverse.factor_ = std::move(factor);
  inverse.Compute();
  return inverse;
}

// Column by column from the last: Q_ij = -sum_k L_kj Q_ik over the column's rows k, and
// Q_jj = 1 / D_j - sum_k L_kj Q_kj. All Q_ik asked for lie in the pattern, so are known already.
void SelectedInverse::Compute() {
  const auto lower = factor_->matrixL().nestedExpression();
  const Eigen::VectorXd pivots = factor_->vectorD();
  const int size = static_cast<int>(pivots.size());
  const auto& permutation = factor_->permutationP().indices();
  permuted_.assign(permutation.data(), permutation.data() + size);
  start_.assign(1, 0);
  std::vector<double> l;
  row_.reserve(static_cast<size_t>(lower.nonZeros()));
  l.reserve(row_.capacity());
  for (int j = 0; j < size; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      if (entry.row() <= j) continue;
      row_.push_back(static_cast<int>(entry.row()));
      l.push_back(entry.value());
    }
    start_.push_back(static_cast<int>(row_.size()));
  }
  lower_.assign(row_.size(), 0);
  diagonal_.assign(size, 0);
  std::vector<int> place(size, -1);  // of a row in the present column, for rows at or after `start`
  for (int j = size - 1; j >= 0; --j) {
    const int start = start_[j], end = start_[j + 1];
    for (int a = start; a < end; ++a) place[row_[a]] = a;
    for (int a = start; a < end; ++a) {
      const int k = row_[a];
      double sum = l[a] * diagonal_[k];
      for (int b = start_[k]; b < start_[k + 1]; ++b) {
        const int other = place[row_[b]];
        if (other < start) continue;
        sum += l[other] * lower_[b];
        lower_[other] -= l[a] * lower_[b];
      }
      lower_[a] -= sum;
    }
    double sum = 1 / pivots[j];
    for (int a = start; a < end; ++a) sum -= l[a] * lower_[a];
    diagonal_[j] = sum;
    for (int a = start; a < end; ++a) place[row_[a]] = -1;
  }
}

double SelectedInverse::Raw(int row, int column) const {
  const int i = permuted_[row], j = permuted_[column];
  if (i == j) return diagonal_[i] * scales_[row] * scales_[row];
  const auto first = row_.begin() + start_[std::min(i, j)];
  const auto last = row_.begin() + start_[std::min(i, j) + 1];
  const auto found = std::lower_bound(first, last, std::max(i, j));
  INSITU_CHECK(found != last && *found == std::max(i, j));
  return lower_[found - row_.begin()] * scales_[row] * scales_[column];
}

double SelectedInverse::At(int row, int column) const {
  double value = Raw(row, column);
  for (Eigen::Index k = 0; k < motion_.cols(); ++k) {
    value -= motion_(row, k) * shift_(column, k) + shift_(row, k) * motion_(column, k);
  }
  return value;
}

Eigen::MatrixXd SelectedInverse::Block(int row, int rows, int column, int columns) const {
  Eigen::MatrixXd block(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) block(i, j) = At(row + i, column + j);
  }
  return block;
}

Eigen::MatrixXd SelectedInverse::Times(const Eigen::MatrixXd& b) const {
  const Eigen::MatrixXd scaled = scales_.asDiagonal() * b;
  const Eigen::MatrixXd product = scales_.asDiagonal() * factor_->solve(scaled);
  if (motion_.cols() == 0) return product;
  return product - motion_ * (shift_.transpose() * b) - shift_ * (motion_.transpose() * b);
}

// With M = G (B^T G)^-1, R = Q B and C = B^T Q B: S Q S^T = Q - M R^T - R M^T + M C M^T, and C is
// symmetric, so T = R - M C / 2.
void SelectedInverse::ChangeDatum(const Eigen::MatrixXd& g, const Eigen::MatrixXd& b) {
  INSITU_CHECK(motion_.cols() == 0);
  const Eigen::MatrixXd response = Times(b);
  const Eigen::MatrixXd mixed = b.transpose() * g, inverse = mixed.inverse();
  const Eigen::MatrixXd motion = g * inverse;
  shift_ = response - motion * (b.transpose() * response) / 2;
  motion_ = motion;
}

}  // namespace insitu
