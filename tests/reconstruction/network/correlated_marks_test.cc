// SPDX-License-Identifier: GPL-3.0-or-later
// Free networks of tie points whose errors are alike in a neighbourhood, as those of real matching.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <random>

#include "reconstruction/network/mark_correlation.h"
#include "reconstruction/network/solve_network.h"

namespace insitu {
namespace {

constexpr int kWidth = 3000, kHeight = 2000, kPhotos = 6, kPoints = 500;

// A Gaussian field over a photograph, of unit variance and with Gaussian correlation of a length.
class Field {
 public:
  Field(double length_px, std::mt19937* generator) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0, 2 * M_PI);
    for (int i = 0; i < kWaves; ++i) {
      waves_[i] = {normal(*generator) / length_px, normal(*generator) / length_px,
                   phase(*generator)};
    }
  }
  double At(const Eigen::Vector2d& pixel) const {
    double sum = 0;
    for (const Eigen::Vector3d& wave : waves_) {
      sum += std::cos(wave.head<2>().dot(pixel) + wave.z());
    }
    return std::sqrt(2.0 / kWaves) * sum;
  }

 private:
  static constexpr int kWaves = 64;
  std::array<Eigen::Vector3d, kWaves> waves_;
};

// Two walls and the ground before them, from an arc: the truth as start values.
Network Walls(std::mt19937* generator) {
  std::uniform_real_distribution<double> unit(0, 1);
  Network network;
  network.directions = {{"zenith", Eigen::Vector3d::UnitZ(), true}};
  network.cameras.push_back(
      {"camera", Camera::Pinhole(2400, 2400, 1499.5, 999.5, kWidth, kHeight)});
  for (int i = 0; i < kPoints; ++i) {
    const double a = unit(*generator), b = unit(*generator);
    Eigen::Vector3d point(20 * a - 10, 0.5 * unit(*generator), 12 * b);
    if (i % 3 == 1) point = {-10 + 0.5 * unit(*generator), -10 * a, 12 * b};
    if (i % 3 == 2) point = {20 * a - 10, -8 * b, 0.2 * unit(*generator)};
    network.points.push_back({"tie" + std::to_string(i), point, false, true});
  }
  for (int i = 0; i < kPhotos; ++i) {
    const Eigen::Vector3d center(-9 + 4.0 * i, -24 + unit(*generator), 2 + 2 * unit(*generator));
    const Eigen::Vector3d forward = (Eigen::Vector3d(0.3 * i - 1, -2, 5) - center).normalized();
    Eigen::Matrix3d rotation;
    rotation.row(2) = forward;
    rotation.row(0) = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    rotation.row(1) = forward.cross(rotation.row(0).transpose());
    network.photos.push_back(
        {"photo" + std::to_string(i), 0, Eigen::Quaterniond(rotation), center});
  }
  return network;
}

// Marks on four photos a point, with errors of their own and such as their neighbours have.
void AddMarks(double own_px, double shared_px, std::mt19937* generator, Network* network) {
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> any(0, kPhotos - 1);
  const Camera& camera = std::get<Camera>(network->cameras[0].lens);
  std::vector<Field> x, y;
  for (int i = 0; i < kPhotos; ++i) {
    x.emplace_back(kWidth / 10.0, generator);
    y.emplace_back(kWidth / 10.0, generator);
  }
  for (int point = 0; point < kPoints; ++point) {
    const int left_out = any(*generator);
    for (int photo = 0; photo < kPhotos; ++photo) {
      if (photo == left_out || photo == (left_out + 2) % kPhotos) continue;
      const NetworkPhoto& posed = network->photos[photo];
      const auto pixel =
          camera.Project(posed.cam_from_local * (network->points[point].position - posed.center));
      const Eigen::Vector2d error(own_px * normal(*generator) + shared_px * x[photo].At(*pixel),
                                  own_px * normal(*generator) + shared_px * y[photo].At(*pixel));
      network->marks.push_back({photo, point, *pixel + error, std::hypot(own_px, shared_px)});
    }
  }
}

// Whether the truth is within the 95 % ellipsoid of a photo's rotation and centre.
bool HoldsTruth(const Network& truth, const Network& solved, const NetworkSolution& solution,
                int photo) {
  constexpr double kChiSquare6 = 12.592;
  const Eigen::Quaterniond turn =
      solved.photos[photo].cam_from_local * truth.photos[photo].cam_from_local.conjugate();
  Eigen::Matrix<double, 6, 1> off;
  off << 2 * turn.vec() * (turn.w() < 0 ? -1 : 1),
      solved.photos[photo].center - truth.photos[photo].center;
  const Eigen::MatrixXd covariance = Covariance(solved, solution, *solution.columns.rotation[photo],
                                                6, *solution.columns.rotation[photo], 6);
  return off.dot(covariance.ldlt().solve(off)) < kChiSquare6;
}

struct Coverage {
  double share = 0, mean_sigma0 = 0, mean_inflation = 0;
};

Coverage CoverageOf(double own_px, double shared_px, int networks) {
  Coverage coverage;
  for (int seed = 0; seed < networks; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    Network truth = Walls(&generator);
    AddMarks(own_px, shared_px, &generator, &truth);
    Network solved = truth;
    const NetworkSolution solution = SolveNetwork(&solved);
    for (int photo = 0; photo < kPhotos; ++photo) {
      coverage.share += HoldsTruth(truth, solved, solution, photo) / (1.0 * networks * kPhotos);
    }
    coverage.mean_sigma0 += solution.sigma0 / networks;
    coverage.mean_inflation += *solved.tie_mark_inflation / networks;
  }
  return coverage;
}

TEST(CorrelatedMarks, IndependentOnesAreTakenForThat) {
  const Coverage coverage = CoverageOf(0.5, 0, 40);
  EXPECT_NEAR(coverage.mean_sigma0, 1, 0.01);
  EXPECT_LT(coverage.mean_inflation, 1.2);
  EXPECT_GE(coverage.share, 0.90);
  EXPECT_LE(coverage.share, 0.99);
}

TEST(CorrelatedMarks, IntervalsHoldTheTruth) {
  const Coverage coverage = CoverageOf(0.4, 0.3, 40);
  EXPECT_GT(coverage.mean_inflation, 2);
  EXPECT_GE(coverage.share, 0.90);
  EXPECT_LE(coverage.share, 0.99);
}

}  // namespace
}  // namespace insitu
