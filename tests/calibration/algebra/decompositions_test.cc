// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/algebra/decompositions.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace insitu {
namespace {

// Of an ellipsoid with semi-axes 1, 2, 3, turned.
Eigen::Matrix3d Ellipsoid(const Eigen::Matrix3d& turn) {
  return turn * Eigen::Vector3d(1, 4, 9).asDiagonal() * turn.transpose();
}

Eigen::Matrix3d Turned() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix();
}

TEST(EigenOfSymmetric, AscendingWithTheAxesAsColumns) {
  const SymmetricEigen<3> axes = EigenOfSymmetric(Ellipsoid(Turned()));
  EXPECT_TRUE(axes.values.isApprox(Eigen::Vector3d(1, 4, 9), 1e-12));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::abs(axes.vectors.col(k).dot(Turned().col(k))), 1, 1e-12);
  }
  const auto same = EigenOfSymmetric<Eigen::Dynamic>(Ellipsoid(Turned()));
  EXPECT_TRUE(same.values.isApprox(axes.values, 1e-12));
}

TEST(EigenOfSymmetric, OfTwoRowsInClosedForm) {
  Eigen::Matrix2d matrix;
  matrix << 2, 1, 1, 2;
  const SymmetricEigen<2> axes = EigenOfSymmetric(matrix);
  EXPECT_TRUE(axes.values.isApprox(Eigen::Vector2d(1, 3), 1e-15));
  EXPECT_NEAR(std::abs(axes.vectors.col(1).sum()), std::sqrt(2.0), 1e-15);
}

TEST(SolveSymmetric, ReadsTheLowerTriangleAndLeavesTheUndeterminedAtZero) {
  Eigen::Matrix3d a = Ellipsoid(Turned());
  const Eigen::Vector3d x(3, -1, 2), b = a * x;
  const Eigen::MatrixXd inverse = InverseOfSymmetric(a);
  EXPECT_TRUE((inverse * a).isIdentity(1e-12));
  a(0, 2) = 77;
  EXPECT_TRUE(SolveSymmetric(a, b).isApprox(x, 1e-12));

  Eigen::MatrixXd weak = Eigen::MatrixXd::Zero(2, 2);
  weak(0, 0) = 4;
  EXPECT_EQ(SolveSymmetric(weak, Eigen::Vector2d(8, 0)), Eigen::Vector2d(2, 0));
}

TEST(SolveLeastSquares, LineThroughPointsAndItsRank) {
  Eigen::MatrixXd a(4, 2);
  a << 0, 1, 1, 1, 2, 1, 3, 1;
  const LeastSquaresSolution line = SolveLeastSquares(a, Eigen::Vector4d(1, 3.3, 4.7, 7));
  EXPECT_EQ(line.rank, 2);
  EXPECT_NEAR(line.x(0), 1.94, 1e-12);
  EXPECT_NEAR(line.x(1), 1.09, 1e-12);

  a.col(0) = 1e-6 * Eigen::Vector4d(1, 2, 3, 4) + a.col(1);
  EXPECT_EQ(SolveLeastSquares(a, a.col(1)).rank, 2);
  EXPECT_EQ(SolveLeastSquares(a, a.col(1), 1e-3).rank, 1);
}

TEST(PivotOrder, TheLongestColumnThenWhatItDoesNotSay) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3, 3);
  a.col(0) = Eigen::Vector3d(0, 2, 0);
  a.col(1) = Eigen::Vector3d(0, 5, 0.1);
  a.col(2) = Eigen::Vector3d(1, 0, 0);
  EXPECT_EQ(PivotOrder(a), Eigen::Vector3i(1, 2, 0));
}

TEST(OrthonormalBasis, SpansTheColumns) {
  Eigen::MatrixXd a(4, 2);
  a << 1, 2, 0, 1, 3, -1, 2, 2;
  const Eigen::MatrixXd basis = OrthonormalBasis(a);
  ASSERT_EQ(basis.cols(), 2);
  EXPECT_TRUE((basis.transpose() * basis).isIdentity(1e-14));
  EXPECT_TRUE((basis * basis.transpose() * a).isApprox(a, 1e-14));
}

TEST(SingularValuesOf, DescendingWithRightVectors) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 2);
  a(1, 0) = 2;
  a(3, 1) = -5;
  const SingularValues singular = SingularValuesOf(a);
  EXPECT_TRUE(singular.values.isApprox(Eigen::Vector2d(5, 2), 1e-15));
  EXPECT_NEAR(std::abs(singular.right(1, 0)), 1, 1e-15);
}

TEST(Decorrelation, MakesTheCovarianceOneOverManyPowersOfTen) {
  Eigen::Matrix3d covariance = Ellipsoid(Turned());
  const Eigen::Vector3d units(1e5, 1, 1e-9);
  covariance = units.asDiagonal() * covariance * units.asDiagonal();
  const auto w = Decorrelation(covariance);
  ASSERT_TRUE(w);
  EXPECT_TRUE((*w * covariance * w->transpose()).isIdentity(1e-10));

  covariance.row(1).setZero();
  EXPECT_FALSE(Decorrelation(covariance));
  Eigen::Matrix2d impossible;
  impossible << 1, 2, 2, 1;
  EXPECT_FALSE(Decorrelation(impossible));
}

TEST(RotationBetween, TakesOneDirectionToTheOther) {
  const Eigen::Vector3d from(1, 2, 3), to(-2, 0.5, 1);
  EXPECT_TRUE((RotationBetween(from, to) * from.normalized()).isApprox(to.normalized(), 1e-14));
  EXPECT_TRUE((RotationBetween(from, -from) * from).isApprox(-from, 1e-12));
}

}  // namespace
}  // namespace insitu
