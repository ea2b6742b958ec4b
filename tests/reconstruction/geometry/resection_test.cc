// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/resection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <random>

namespace insitu {
namespace {

using Eigen::Vector3d;

const Vector3d kGrid(2600000, 1200000, 450);

Camera Lens() {
  return Camera("LENSMODEL_OPENCV8",
                {1500, 1502, 899.5, 601.5, -0.12, 0.03, 5e-4, -3e-4, 0, 0, 0, 0}, 1800, 1200);
}

// Upright, looking along +y, a little turned and tilted.
Rigid3 TruePose(const Vector3d& center) {
  const Eigen::Quaterniond upright(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2, Vector3d(0.3, 1, 0.2).normalized()));
  const Eigen::Quaterniond rotation = turn * upright;
  return {rotation, -(rotation * center)};
}

std::vector<ResectionPoint> Seen(const Camera& camera, const Rigid3& cam_from_world,
                                 const std::vector<Vector3d>& world) {
  std::vector<ResectionPoint> points;
  for (const Vector3d& point : world) {
    points.push_back({point, *camera.Project(cam_from_world * point), 0.5});
  }
  return points;
}

std::vector<Vector3d> Cloud(const Vector3d& origin, int count, bool flat = false) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = 8 * uniform(generator), y = 25 + 10 * uniform(generator);
    points.push_back(origin + Vector3d(x, y, flat ? -1.5 : 5 * uniform(generator)));
  }
  return points;
}

double AngleBetween(const Rigid3& a, const Rigid3& b) {
  return a.rotation.angularDistance(b.rotation);
}

class ResectionOfManyPoints : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(ResectionOfManyPoints, ReturnsThePoseToRounding) {
  const auto [count, flat] = GetParam();
  const Rigid3 truth = TruePose(kGrid);
  const auto found = Resect(Lens(), Seen(Lens(), truth, Cloud(kGrid, count, flat)));
  ASSERT_TRUE(found);
  EXPECT_LT((Center(found->cam_from_world) - kGrid).norm(), 1e-8);
  EXPECT_LT(AngleBetween(found->cam_from_world, truth), 1e-9);
  EXPECT_LT(found->rms_px, 1e-6);
  EXPECT_FALSE(found->ambiguous);
}

INSTANTIATE_TEST_SUITE_P(FlatAndSolid, ResectionOfManyPoints,
                         testing::Combine(testing::Values(5, 6, 10, 50), testing::Bool()));

// Three points as in [Durisch92, §4.1].
TEST(Resect, ThreePointsGiveThePoseNearestToTheEstimate) {
  const Rigid3 truth = TruePose(kGrid);
  const Rigid3 estimate = TruePose(kGrid + Vector3d(0.5, -0.5, 0.3));
  const auto found = Resect(Lens(), Seen(Lens(), truth, Cloud(kGrid, 3)), estimate);
  ASSERT_TRUE(found);
  EXPECT_LT((Center(found->cam_from_world) - kGrid).norm(), 1e-8);
  EXPECT_FALSE(found->ambiguous);
}

TEST(Resect, ThreePointsWithoutEstimateFitButMayBeAmbiguous) {
  // Above an equilateral triangle, off its middle: several poses see it alike.
  const Vector3d center(0, 0, 0);
  const Rigid3 truth = TruePose(center);
  const std::vector<Vector3d> triangle = {{-3, 12, -2}, {3, 12.5, -2.2}, {0.5, 13, 3}};
  const auto found = Resect(Lens(), Seen(Lens(), truth, triangle));
  ASSERT_TRUE(found);
  EXPECT_LT(found->rms_px, 1e-6);
  EXPECT_TRUE(found->ambiguous);
}

TEST(Resect, RefusesFewerThanThreePoints) {
  const auto points = Seen(Lens(), TruePose(kGrid), Cloud(kGrid, 2));
  EXPECT_FALSE(Resect(Lens(), points));
}

TEST(Resect, RefusesCollinearPoints) {
  std::vector<Vector3d> line;
  for (int i = 0; i < 6; ++i) line.push_back(kGrid + Vector3d(i - 3.0, 20 + 0.5 * i, 1 + 0.1 * i));
  EXPECT_FALSE(Resect(Lens(), Seen(Lens(), TruePose(kGrid), line)));
}

TEST(AreCollinear, ComparesTheSpreads) {
  EXPECT_TRUE(AreCollinear({kGrid, kGrid + Vector3d(10, 0, 0)}));
  EXPECT_TRUE(AreCollinear({kGrid, kGrid + Vector3d(10, 0, 0), kGrid + Vector3d(5, 0.001, 0)}));
  EXPECT_FALSE(AreCollinear({kGrid, kGrid + Vector3d(10, 0, 0), kGrid + Vector3d(5, 0.1, 0)}));
  EXPECT_TRUE(AreCollinear({kGrid, kGrid, kGrid}));
}

// Normalised errors e^T C^-1 e of 100 noisy resections: chi-square with 6 degrees of freedom, mean
// 6, standard deviation of the mean sqrt(12 / 100).
TEST(Resect, ErrorsFollowTheCovariance) {
  const Rigid3 truth = TruePose(Vector3d::Zero());
  const auto exact = Seen(Lens(), truth, Cloud(Vector3d::Zero(), 12));
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  double sum = 0;
  const int trials = 100;
  for (int trial = 0; trial < trials; ++trial) {
    auto noisy = exact;
    for (auto& point : noisy) {
      for (int i = 0; i < 2; ++i) point.pixel[i] += point.sigma_px * normal(generator);
    }
    const auto found = Resect(Lens(), noisy);
    ASSERT_TRUE(found);
    const Eigen::AngleAxisd increment(found->cam_from_world.rotation * truth.rotation.conjugate());
    Eigen::Matrix<double, 6, 1> error;
    error << increment.angle() * increment.axis(), Center(found->cam_from_world);
    sum += error.dot(found->covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / trials, 6, 4 * std::sqrt(12.0 / trials));
}

}  // namespace
}  // namespace insitu
