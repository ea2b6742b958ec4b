// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/statistics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
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

TEST(Cofactor, IsTheInverseOfTheNormalMatrix) {
  const Jacobian jacobian = RandomJacobian(40, 12);
  const auto cofactor = Cofactor(jacobian);
  ASSERT_TRUE(cofactor);
  const Eigen::MatrixXd identity = *cofactor * Eigen::MatrixXd(jacobian.transpose() * jacobian);
  EXPECT_LT((identity - Eigen::MatrixXd::Identity(12, 12)).norm(), 1e-6);
}

TEST(RedundancyNumbers, SumToTheRedundancy) {
  const Jacobian jacobian = RandomJacobian(40, 12);
  const Eigen::VectorXd redundancy = RedundancyNumbers(jacobian, *Cofactor(jacobian));
  EXPECT_NEAR(redundancy.sum(), 40 - 12, 1e-9);
  EXPECT_GE(redundancy.minCoeff(), 0);
  EXPECT_LE(redundancy.maxCoeff(), 1);
}

TEST(RedundancyNumbers, OfAMeanOfFourAreThreeQuarters) {
  Jacobian jacobian(4, 1);
  for (int row = 0; row < 4; ++row) jacobian.insert(row, 0) = 7;
  for (const double r : RedundancyNumbers(jacobian, *Cofactor(jacobian)))
    EXPECT_NEAR(r, 0.75, 1e-15);
}

TEST(Cofactor, IsRefusedOnARankDefectAndTheUnknownsAreFound) {
  Jacobian jacobian = RandomJacobian(40, 12);
  // Column 5 becomes a multiple of column 9: neither can be told from the other.
  for (int row = 0; row < 40; ++row) jacobian.coeffRef(row, 5) = -3 * jacobian.coeff(row, 9);
  EXPECT_FALSE(Cofactor(jacobian));
  EXPECT_EQ(UndeterminedColumns(jacobian), (std::vector<int>{5, 9}));
}

TEST(Cofactor, IsRefusedWithAnUnknownThatNothingObserves) {
  Jacobian jacobian = RandomJacobian(40, 12);
  jacobian.conservativeResize(40, 13);
  EXPECT_FALSE(Cofactor(jacobian));
  EXPECT_EQ(UndeterminedColumns(jacobian), (std::vector<int>{12}));
}

TEST(ChiSquareTwoSided, AgreesWithTheTables) {
  EXPECT_NEAR(ChiSquareTwoSided(18.307, 10), 0.10, 1e-4);  // upper 5 %
  EXPECT_NEAR(ChiSquareTwoSided(3.940, 10), 0.10, 1e-4);   // lower 5 %
  EXPECT_NEAR(ChiSquareTwoSided(99.334, 100), 1.0, 1e-3);  // the median
  EXPECT_EQ(ChiSquareTwoSided(0, 0), 1);
}

}  // namespace
}  // namespace insitu
