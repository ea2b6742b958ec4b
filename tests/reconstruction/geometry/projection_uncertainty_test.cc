// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/projection_uncertainty.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "tests/reconstruction/network/random_network.h"

namespace insitu {
namespace {

PosedCamera AtOrigin() { return {"photo", Camera::Pinhole(1000, 1000, 500, 400, 1001, 801), {}}; }

TEST(ProjectWithUncertainty, OfACentreAcrossIsFocalLengthOverDepth) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  covariance(3, 3) = 0.01 * 0.01;  // a centimetre along x
  const auto result = ProjectWithUncertainty(AtOrigin(), covariance, {0, 0, 20});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->major_px, 1000 * 0.01 / 20, 1e-12);
  EXPECT_NEAR(result->minor_px, 0, 1e-9);
  EXPECT_NEAR(result->major_m, 0.01, 1e-12);
}

TEST(ProjectWithUncertainty, OfARotationIsTheFocalLength) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  covariance(1, 1) = 1e-8;  // 1e-4 rad about y
  for (const double depth : {2., 200.}) {
    const auto result = ProjectWithUncertainty(AtOrigin(), covariance, {0, 0, depth});
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->major_px, 0.1, 1e-12);
    EXPECT_NEAR(result->major_m, 1e-4 * depth, 1e-12);
  }
}

TEST(ProjectWithUncertainty, OfThePrincipalPointIsItsOwn) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(10, 10);
  covariance(8, 8) = 0.25;
  const auto result = ProjectWithUncertainty(AtOrigin(), covariance, {1, 2, 10});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->major_px, 0.5, 1e-12);
}

TEST(ProjectWithUncertainty, RefusesWhatThePhotographDoesNotShow) {
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(6, 6);
  EXPECT_FALSE(ProjectWithUncertainty(AtOrigin(), covariance, {0, 0, -5}));
  EXPECT_FALSE(ProjectWithUncertainty(AtOrigin(), covariance, {9, 0, 5}));
}

// A planned corner in 150 adjusted networks, each with its own errors of marks, survey and lens.
TEST(ProjectWithUncertainty, HoldsTheTrueImageInNinetyFivePercent) {
  const Network truth = MakeRandomNetwork(11);
  const auto& lens = std::get<Camera>(truth.cameras[0].lens);
  const Eigen::VectorXd lens_sigma =
      (Eigen::VectorXd(8) << 1, 1, 1, 1, 5e-4, 5e-4, 1e-4, 1e-4).finished();
  const Eigen::Vector3d corner = truth.origin + Eigen::Vector3d(1, 2, 6);
  const auto posed = [&](const Network& network, int photo) {
    const NetworkPhoto& p = network.photos[photo];
    const Eigen::Vector3d center = p.center + network.origin;
    return PosedCamera{p.name,
                       std::get<Camera>(network.cameras[p.camera].lens),
                       {p.cam_from_local, -(p.cam_from_local * center)}};
  };
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int inside = 0, count = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    Network network = WithNoise(truth, seed);
    std::vector<double> intrinsics = lens.intrinsics();
    for (int i = 0; i < 8; ++i) intrinsics[i] += lens_sigma[i] * normal(random);
    network.cameras[0].lens = Camera(lens.lens_model(), intrinsics, lens.width(), lens.height());
    network.cameras[0].calibration_covariance = lens_sigma.cwiseAbs2().asDiagonal();
    const NetworkSolution solution = SolveNetwork(&network);
    const std::vector<Eigen::MatrixXd> covariances = CameraCovariances(network, solution);
    for (int photo = 0; photo < 5; ++photo) {
      const auto true_image =
          ProjectWithUncertainty(posed(truth, photo), Eigen::MatrixXd::Zero(6, 6), corner);
      const auto image = ProjectWithUncertainty(posed(network, photo), covariances[photo], corner);
      ASSERT_TRUE(true_image && image);
      const Eigen::Vector2d error = image->pixel - true_image->pixel;
      ++count;
      inside += error.dot(image->covariance_px.inverse() * error) < 5.9915;  // chi-square, 2, 95 %
    }
  }
  EXPECT_NEAR(inside / static_cast<double>(count), 0.95, 0.03);
}

// J C J^T of point and camera together, J by differences.
TEST(ProjectWithUncertainty, CountsThePointAndWhatItSharesWithTheCamera) {
  const Camera camera("LENSMODEL_OPENCV8",
                      {1500, 1502, 899.5, 601.5, -0.12, 0.03, 5e-4, -3e-4, 0, 0, 0, 0}, 1800, 1200);
  const Eigen::Quaterniond rotation(
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, -2, 0.5).normalized()));
  const Eigen::Vector3d center(2, -1, 0.5);
  const PosedCamera posed{"P", camera, {rotation, -(rotation * center)}};
  const Eigen::Vector3d world = center + rotation.conjugate() * Eigen::Vector3d(1.5, -0.8, 9);
  const auto pixel = [&](const Eigen::VectorXd& step) {
    const Eigen::Vector3d turn = step.segment<3>(3);
    const double angle = turn.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(turn / angle) : turn;
    const Eigen::Quaterniond turned = Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) * rotation;
    return *camera.Project(turned * (world + step.head<3>() - center - step.tail<3>()));
  };
  Eigen::MatrixXd jacobian(2, 9);
  for (int i = 0; i < 9; ++i) {
    const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(9, i);
    jacobian.col(i) = (pixel(step) - pixel(-step)) / 2e-6;
  }
  std::srand(7);
  const Eigen::MatrixXd root = 1e-3 * Eigen::MatrixXd::Random(9, 9);
  const Eigen::MatrixXd joint = root * root.transpose();
  const PointUncertainty point{joint.topLeftCorner<3, 3>(), joint.topRightCorner(3, 6)};
  const auto image = ProjectWithUncertainty(posed, joint.bottomRightCorner(6, 6), world, point);
  ASSERT_TRUE(image);
  const Eigen::Matrix2d expected = jacobian * joint * jacobian.transpose();
  EXPECT_LT((image->covariance_px - expected).norm(), 1e-6 * expected.norm());
}

}  // namespace
}  // namespace insitu
