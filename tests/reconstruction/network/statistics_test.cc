// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/statistics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

namespace insitu {
namespace {

// A random sparse Jacobian with columns of very unequal size.
Jacobian RandomJacobian(int rows, int columns) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  Jacobian jacobian(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < 3; ++k) {
      const int column = (row + 2 * k) % columns;
      jacobian.coeffRef(row, column) = normal(generator) * std::pow(10, column % 5);
    }
  }
  return jacobian;
}

SelectedInverse CofactorOf(const Jacobian& jacobian) {
  return SelectedInverse::Of(NormalMatrix(jacobian)).value();
}

TEST(SelectedInverse, IsTheInverseAtThePattern) {
  const Jacobian jacobian = RandomJacobian(400, 120);
  const Eigen::SparseMatrix<double> normal = NormalMatrix(jacobian);
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(normal).inverse();
  const SelectedInverse selected = CofactorOf(jacobian);
  for (int column = 0; column < normal.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(normal, column); entry; ++entry) {
      const auto row = static_cast<int>(entry.row());
      EXPECT_NEAR(selected.At(row, column) / inverse(row, column), 1, 1e-6);
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1, 2);
  EXPECT_LT((normal * selected.Times(b) - b).norm(), 1e-6);
}

// Heights between five points in a ring tell no height of any.
TEST(SelectedInverse, InTheDatumOfInnerConstraintsIsThePseudoInverse) {
  Jacobian jacobian(7, 5);
  for (int row = 0; row < 7; ++row) {
    jacobian.insert(row, row % 5) = -(1 + row);
    jacobian.insert(row, (row + 1 + row / 5) % 5) = 1 + row;
  }
  Eigen::SparseMatrix<double> normal = NormalMatrix(jacobian);
  EXPECT_FALSE(SelectedInverse::Of(normal));
  const Eigen::MatrixXd pseudo_inverse =
      Eigen::MatrixXd(normal).completeOrthogonalDecomposition().pseudoInverse();
  normal.coeffRef(2, 2) *= 2;
  SelectedInverse selected = SelectedInverse::Of(normal).value();
  const Eigen::MatrixXd ones = Eigen::VectorXd::Ones(5);
  selected.ChangeDatum(ones, ones);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(selected.At(i, i), pseudo_inverse(i, i), 1e-12);
    EXPECT_NEAR(selected.At(i, (i + 1) % 5), pseudo_inverse(i, (i + 1) % 5), 1e-12);
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(5, -1, 2);
  EXPECT_LT((selected.Times(b) - pseudo_inverse * b).norm(), 1e-12);
}

TEST(RedundancyNumbers, SumToTheRedundancy) {
  const Jacobian jacobian = RandomJacobian(40, 12);
  const Eigen::VectorXd redundancy = RedundancyNumbers(jacobian, CofactorOf(jacobian));
  EXPECT_NEAR(redundancy.sum(), 40 - 12, 1e-9);
  EXPECT_GE(redundancy.minCoeff(), 0);
  EXPECT_LE(redundancy.maxCoeff(), 1);
}

TEST(RedundancyNumbers, OfAMeanOfFourAreThreeQuarters) {
  Jacobian jacobian(4, 1);
  for (int row = 0; row < 4; ++row) jacobian.insert(row, 0) = 7;
  for (const double r : RedundancyNumbers(jacobian, CofactorOf(jacobian)))
    EXPECT_NEAR(r, 0.75, 1e-15);
}

TEST(SelectedInverse, IsRefusedOnARankDefectAndTheUnknownsAreFound) {
  Jacobian jacobian = RandomJacobian(40, 12);
  // Column 5 becomes a multiple of column 9: neither can be told from the other.
  for (int row = 0; row < 40; ++row) jacobian.coeffRef(row, 5) = -3 * jacobian.coeff(row, 9);
  const Eigen::SparseMatrix<double> normal = NormalMatrix(jacobian);
  EXPECT_FALSE(SelectedInverse::Of(normal));
  EXPECT_EQ(UndeterminedColumns(normal), (std::vector<int>{5, 9}));
}

TEST(SelectedInverse, IsRefusedWithAnUnknownThatNothingObserves) {
  Jacobian jacobian = RandomJacobian(40, 12);
  jacobian.conservativeResize(40, 13);
  const Eigen::SparseMatrix<double> normal = NormalMatrix(jacobian);
  EXPECT_FALSE(SelectedInverse::Of(normal));
  EXPECT_EQ(UndeterminedColumns(normal), (std::vector<int>{12}));
}

TEST(CriticalTestValue, AgreesWithBaarda) {
  EXPECT_NEAR(CriticalTestValue(0.001), 3.2905, 1e-4);
  EXPECT_NEAR(DetectableNoncentrality(0.001), 4.1321, 1e-4);
  EXPECT_NEAR(NormalTwoSided(1.959964), 0.05, 1e-7);
}

TEST(ChiSquareTwoSided, AgreesWithTheTables) {
  EXPECT_NEAR(ChiSquareTwoSided(18.307, 10), 0.10, 1e-4);  // upper 5 %
  EXPECT_NEAR(ChiSquareTwoSided(3.940, 10), 0.10, 1e-4);   // lower 5 %
  EXPECT_NEAR(ChiSquareTwoSided(99.334, 100), 1.0, 1e-3);  // the median
  EXPECT_EQ(ChiSquareTwoSided(0, 0), 1);
  EXPECT_NEAR(ChiSquareQuantile(10, 0.95), 18.307, 1e-3);
}

}  // namespace
}  // namespace insitu
