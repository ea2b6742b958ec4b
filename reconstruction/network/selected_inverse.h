// SPDX-License-Identifier: GPL-3.0-or-later
// Those elements of the inverse of a sparse normal matrix that an adjustment's statistics need.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

namespace insitu {

// Inverse Q of a symmetric positive definite matrix, at the pattern of its Cholesky factor, which
// holds the matrix's own pattern. Takahashi, Fagan & Chen, "Formation of a sparse bus impedance
// matrix", PICA 1973; Erisman & Tinney, CACM 18 (1975). As many operations as the factor.
class SelectedInverse {
 public:
  // nullopt on a rank defect or an element that is not finite: a pivot of the matrix with unit
  // diagonal below 1e-12.
  static std::optional<SelectedInverse> Of(const Eigen::SparseMatrix<double>& normal);

  SelectedInverse() = default;

  // Q(rows, columns) for consecutive indices; each must be in the pattern, as all the unknowns of
  // one observation are with one another.
  Eigen::MatrixXd Block(int row, int rows, int column, int columns) const;
  double At(int row, int column) const;

  // Q b, for any b (n x k).
  Eigen::MatrixXd Times(const Eigen::MatrixXd& b) const;

  // Q becomes S Q S^T with S = I - G (B^T G)^-1 B^T: the datum that B^T x = 0 defines instead of
  // the one Q has. G, B: n x d. [Baarda, S-transformations and criterion matrices, 1973]
  void ChangeDatum(const Eigen::MatrixXd& g, const Eigen::MatrixXd& b);

  int size() const { return static_cast<int>(scales_.size()); }

 private:
  void Compute();
  double Raw(int row, int column) const;

  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
  std::shared_ptr<const Factor> factor_;  // of the matrix scaled to a unit diagonal
  Eigen::VectorXd scales_;
  std::vector<int> start_, row_, permuted_;  // the factor's strictly lower columns; new from old
  std::vector<double> lower_, diagonal_;     // Q at that pattern, scaled
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows motion_, shift_;  // S Q S^T = Q - M T^T - T M^T; or empty
};

}  // namespace insitu
