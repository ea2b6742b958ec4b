// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/network/network_statistics.h"

#include <ceres/sphere_manifold.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "reconstruction/network/solve_network.h"
#include "tests/reconstruction/network/random_network.h"

namespace insitu {
namespace {

constexpr double kWidth95 = 1.959964;  // of a 95 % interval, in sigmas

class Share {
 public:
  void Add(bool is_inside) {
    ++count_;
    inside_ += is_inside;
  }
  void AddErrors(const Eigen::VectorXd& errors, const Eigen::MatrixXd& covariance) {
    for (int i = 0; i < errors.size(); ++i) {
      Add(std::abs(errors[i]) < kWidth95 * std::sqrt(covariance(i, i)));
    }
  }
  double Value() const { return inside_ / count_; }

 private:
  double count_ = 0, inside_ = 0;
};

// The tangent coordinates of `truth` about `unit`.
Eigen::Vector2d UnitError(const Eigen::Vector3d& unit, const Eigen::Vector3d& truth) {
  Eigen::Vector2d error;
  ceres::SphereManifold<3>().Minus(unit.data(), truth.data(), error.data());
  return error;
}

struct Shares {
  Share pose, vertex, plane, sun, zenith, alarm, found, global;
};

void AddCoverage(const Network& truth, const Network& adjusted, const NetworkSolution& solution,
                 Shares* shares) {
  const NetworkColumns& columns = solution.columns;
  const auto covariance = [&](int column, int count) {
    return Covariance(adjusted, solution, column, count, column, count);
  };
  for (size_t i = 0; i < truth.photos.size(); ++i) {
    Eigen::Matrix<double, 6, 1> error;
    const Eigen::AngleAxisd turn(adjusted.photos[i].cam_from_local *
                                 truth.photos[i].cam_from_local.conjugate());
    error << turn.angle() * turn.axis(), adjusted.photos[i].center - truth.photos[i].center;
    shares->pose.AddErrors(error, covariance(*columns.rotation[i], 6));
  }
  for (const PlaneObservation& on_plane : truth.on_planes) {
    const int point = on_plane.point;
    shares->vertex.AddErrors(adjusted.points[point].position - truth.points[point].position,
                             covariance(*columns.point[point], 3));
  }
  for (size_t i = 0; i < truth.planes.size(); ++i) {
    Eigen::Vector3d error;
    error << UnitError(adjusted.planes[i].normal, truth.planes[i].normal),
        adjusted.planes[i].offset - truth.planes[i].offset;
    shares->plane.AddErrors(error, covariance(*columns.plane[i], 3));
  }
  shares->sun.AddErrors(UnitError(adjusted.directions[0].unit, truth.directions[0].unit),
                        covariance(*columns.direction[0], 2));
  shares->zenith.AddErrors(UnitError(adjusted.directions[1].unit, truth.directions[1].unit),
                           covariance(*columns.direction[1], 2));
}

double TestValue(const NetworkSolution& solution, int row) {
  return solution.residuals[row] /
         (solution.sigmas[row] * std::sqrt(solution.redundancy_numbers[row]));
}

void AddFalseAlarms(const NetworkSolution& solution, Shares* shares) {
  for (int row = 0; row < solution.residuals.size(); ++row) {
    if (solution.redundancy_numbers[row] < 1e-3) continue;
    shares->alarm.Add(std::abs(TestValue(solution, row)) > kWidth95);
  }
  shares->global.Add(ChiSquareTwoSided(solution.square_sum, solution.redundancy) < 0.05);
}

// One mark, drawn at random, is wrong by twice what is detectable.
void AddBlunder(const Network& noisy, const NetworkSolution& solution, unsigned seed,
                Shares* shares) {
  constexpr double kSignificance = 0.001, kControlled = 0.1;
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> draw(0, 2 * static_cast<int>(noisy.marks.size()) - 1);
  int row = draw(random);
  while (solution.redundancy_numbers[row] < kControlled) row = draw(random);
  Network wrong = noisy;
  const ObservationRow& at = solution.rows[row];
  wrong.marks[at.index].pixel[at.component] += 2 * DetectableNoncentrality(kSignificance) *
                                               solution.sigmas[row] /
                                               std::sqrt(solution.redundancy_numbers[row]);
  const NetworkSolution disturbed = SolveNetwork(&wrong);
  shares->found.Add(std::abs(TestValue(disturbed, row)) > CriticalTestValue(kSignificance));
}

}  // namespace

NetworkStatistics SampleNetworkStatistics(int networks) {
  Shares shares;
  NetworkStatistics statistics;
  for (int seed = 1; seed <= networks; ++seed) {
    const Network truth = MakeRandomNetwork(seed);
    const Network noisy = WithNoise(truth, 1000 + seed);
    Network adjusted = WithRoughStart(noisy, 2000 + seed);
    const NetworkSolution solution = SolveNetwork(&adjusted);
    AddCoverage(truth, adjusted, solution, &shares);
    AddFalseAlarms(solution, &shares);
    AddBlunder(noisy, solution, 3000 + seed, &shares);
    statistics.mean_sigma0 += solution.sigma0 / networks;
  }
  statistics.coverage_95 = {shares.pose.Value(), shares.vertex.Value(), shares.plane.Value(),
                            shares.sun.Value(), shares.zenith.Value()};
  statistics.false_alarm_share = shares.alarm.Value();
  statistics.found_blunder_share = shares.found.Value();
  statistics.global_test_share = shares.global.Value();
  return statistics;
}

}  // namespace insitu
