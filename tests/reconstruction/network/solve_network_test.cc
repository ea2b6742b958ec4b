// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/solve_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/reconstruction/network/random_network.h"

namespace insitu {
namespace {

TEST(SolveNetwork, ReturnsToTheTruthFromARoughStart) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Network truth = MakeRandomNetwork(seed);
    Network network = WithRoughStart(truth, seed);
    const NetworkSolution solution = SolveNetwork(&network);
    EXPECT_TRUE(solution.is_converged);
    EXPECT_EQ(solution.datum.defect(), 0);
    EXPECT_NEAR(solution.sigma0, 0, 1e-4);
    for (size_t i = 0; i < truth.points.size(); ++i) {
      EXPECT_LT((network.points[i].position - truth.points[i].position).norm(), 1e-5);
    }
    for (size_t i = 0; i < truth.directions.size(); ++i) {
      EXPECT_LT((network.directions[i].unit - truth.directions[i].unit).norm(), 1e-5);
    }
  }
}

TEST(SolveNetwork, RedundancyNumbersSumToTheRedundancy) {
  Network network = WithNoise(MakeRandomNetwork(3), 1);
  const NetworkSolution solution = SolveNetwork(&network);
  EXPECT_NEAR(solution.redundancy_numbers.sum(), solution.redundancy, 1e-6);
}

// Marks and edges alone, of the points on all photos: nothing that knows a metre.
Network ImagesOnly(const Network& whole) {
  Network images;
  images.cameras = whole.cameras;
  images.photos = whole.photos;
  std::vector<int> rays(whole.points.size(), 0), index(whole.points.size(), -1);
  for (const MarkObservation& mark : whole.marks) ++rays[mark.point];
  for (size_t i = 0; i < whole.points.size(); ++i) {
    if (rays[i] < static_cast<int>(whole.photos.size())) continue;
    index[i] = static_cast<int>(images.points.size());
    images.points.push_back(whole.points[i]);
  }
  for (const MarkObservation& mark : whole.marks) {
    if (index[mark.point] < 0) continue;
    images.marks.push_back(mark);
    images.marks.back().point = index[mark.point];
  }
  return images;
}

// Whatever the datum, residuals, redundancy and shape are the same.
TEST(SolveNetwork, OfAFreeNetworkHasTheSameShapeAsOneHeldByControl) {
  Network held = ImagesOnly(WithNoise(MakeRandomNetwork(4), 1));
  ASSERT_GT(held.points.size(), 30u);
  for (const int point : {0, 10, 20}) {
    held.control.push_back({point, held.points[point].position, Eigen::Vector3d::Constant(10)});
  }
  Network free = held;
  free.control.clear();
  const NetworkSolution with_control = SolveNetwork(&held), without = SolveNetwork(&free);
  EXPECT_EQ(without.datum.defect(), 7);
  EXPECT_NEAR(without.redundancy_numbers.sum(), without.redundancy, 1e-6);
  const int marks = 2 * static_cast<int>(held.marks.size());
  EXPECT_LT((with_control.residuals.head(marks) - without.residuals.head(marks)).norm(), 1e-3);
  EXPECT_LT((with_control.redundancy_numbers.head(marks) - without.redundancy_numbers.head(marks))
                .cwiseAbs()
                .maxCoeff(),
            1e-4);
  const auto ratio = [&](int a, int b) {
    return (free.points[a].position - free.points[b].position).norm() /
           (held.points[a].position - held.points[b].position).norm();
  };
  EXPECT_NEAR(ratio(4, 9) / ratio(12, 20), 1, 1e-6);
}

// The datum stays where the start values put it.
TEST(SolveNetwork, OfAFreeNetworkFitsItsStartValuesAsNearlyAsItCan) {
  Network network = WithNoise(MakeRandomNetwork(5), 1);
  network.control.clear();
  network.centers.clear();
  const Network start = network;
  const NetworkSolution solution = SolveNetwork(&network);
  EXPECT_EQ(solution.datum.defect(), 6);  // a distance holds the scale
  EXPECT_FALSE(solution.datum.is_free[6]);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < start.points.size(); ++i) {
    const Eigen::Vector3d away = network.points[i].position - start.points[i].position;
    shift += away;
    turn += start.points[i].position.cross(away);
  }
  EXPECT_LT(shift.norm(), 1e-6);
  EXPECT_LT(turn.norm(), 1e-3);
}

TEST(SolveNetwork, OneFixedPointLeavesRotationsAndScale) {
  Network network = WithNoise(MakeRandomNetwork(6), 1);
  network.points[network.control[0].point].is_fixed = true;
  network.control.clear();
  network.centers.clear();
  network.distances.clear();
  network.heights.clear();
  const NetworkSolution solution = SolveNetwork(&network);
  EXPECT_EQ(solution.datum.defect(), 4);
}

// A network of marks, planes and sun alone, its zenith fixed.
Network FreeUnderAFixedZenith() {
  Network network = WithNoise(MakeRandomNetwork(9), 1);
  network.control.clear();
  network.centers.clear();
  network.distances.clear();
  network.heights.clear();
  network.angles.clear();
  std::erase_if(network.along_directions, [](const auto& pair) { return pair.direction == 1; });
  network.directions[1].is_fixed = true;
  return network;
}

TEST(SolveNetwork, AFixedZenithHoldsOnlyWhatIsObservedAgainstIt) {
  const Network free = FreeUnderAFixedZenith();
  Network nothing = free;
  EXPECT_EQ(SolveNetwork(&nothing).datum.defect(), 7);
  Network wall = free;  // its normal may still turn about the zenith and about itself
  wall.angles.push_back({PlaneNormal{1}, DirectionUnit{1}, false, 0.002});
  EXPECT_EQ(SolveNetwork(&wall).datum.defect(), 6);
  Network level = free;
  level.heights.push_back({1, 0, 1, 0, 0.005});
  EXPECT_EQ(SolveNetwork(&level).datum.defect(), 6);
  Network plumb = free;
  const auto tower = MakeRandomNetwork(9).along_directions;
  plumb.along_directions.push_back(
      *std::find_if(tower.begin(), tower.end(), [](const auto& pair) { return pair.direction; }));
  EXPECT_EQ(SolveNetwork(&plumb).datum.defect(), 5);
}

TEST(SolveNetwork, NamesAMarkWhosePointLiesBehindTheCamera) {
  Network network = MakeRandomNetwork(7);
  const NetworkPhoto& photo = network.photos[network.marks[10].photo];
  const Eigen::Vector3d forward = photo.cam_from_local.conjugate() * Eigen::Vector3d::UnitZ();
  network.points[network.marks[10].point].position = photo.center - forward;
  try {
    SolveNetwork(&network);
    FAIL() << "expected no solution";
  } catch (const NoSolution& failure) {
    ASSERT_TRUE(failure.row);
    EXPECT_EQ(failure.row->kind, ObservationRow::Kind::kMark);
    EXPECT_EQ(network.marks[failure.row->index].point, network.marks[10].point);
  }
}

TEST(SolveNetwork, CovariancesOfFunctionsAreThoseOfTheirUnknowns) {
  Network network = WithNoise(MakeRandomNetwork(8), 1);
  const NetworkSolution solution = SolveNetwork(&network);
  const int column = *solution.columns.point[3];
  Eigen::MatrixXd by_unknowns = Eigen::MatrixXd::Zero(3, solution.columns.count);
  by_unknowns.middleCols<3>(column).setIdentity();
  const Eigen::MatrixXd direct = Covariance(network, solution, column, 3, column, 3);
  EXPECT_LT((CovarianceOf(network, solution, by_unknowns) - direct).norm(), 1e-9 * direct.norm());
}

TEST(SolveNetwork, NamesWhatNothingDetermines) {
  Network network = MakeRandomNetwork(7);
  network.points.push_back({"lonely", {1, 2, 3}});
  const int lonely = static_cast<int>(network.points.size()) - 1;
  network.distances.push_back({0, lonely, network.points[0].position.norm() + 1, 0.01});
  try {
    SolveNetwork(&network);
    FAIL() << "expected a rank defect";
  } catch (const RankDefect& defect) {
    ASSERT_FALSE(defect.columns.empty());
    for (const RankDefect::Column& column : defect.columns) {
      EXPECT_EQ(column.unknown.kind, Unknown::Kind::kPoint);
      EXPECT_EQ(column.unknown.index, lonely);
      EXPECT_LT(column.component, 3);
    }
  }
}

TEST(SolveNetwork, SelfCalibrationFindsTheLens) {
  const Network truth = MakeRandomNetwork(8);
  Network network = WithRoughStart(truth, 1);
  const auto& lens = std::get<Camera>(truth.cameras[0].lens);
  std::vector<double> wrong = lens.intrinsics();
  wrong[0] *= 1.01;
  wrong[4] += 0.01;
  network.cameras[0].lens = Camera(lens.lens_model(), wrong, lens.width(), lens.height());
  network.cameras[0].is_free = {true, true, true, true, true, true, true, false};
  const NetworkSolution solution = SolveNetwork(&network);
  const auto& adjusted = std::get<Camera>(network.cameras[0].lens);
  for (size_t i = 0; i < wrong.size(); ++i) {
    EXPECT_NEAR(adjusted.intrinsics()[i], lens.intrinsics()[i], 1e-3) << i;
  }
  EXPECT_NEAR(solution.redundancy_numbers.sum(), solution.redundancy, 1e-6);
}

// What is known of the lens adds up: the inverse of its cofactors grows by that of the calibration.
TEST(SolveNetwork, SelfCalibrationHeedsTheCalibration) {
  Network network = MakeRandomNetwork(8);
  network.cameras[0].is_free = {true, true, true, true, true, true, true, false};
  const auto lens_cofactor = [&](const NetworkSolution& solution) {
    const int column = *solution.columns.camera[0];
    return Eigen::MatrixXd(solution.cofactor.Block(column, 7, column, 7));
  };
  const NetworkSolution alone = SolveNetwork(&network);
  Eigen::MatrixXd root = Eigen::MatrixXd::Constant(8, 8, 0.3);
  root.diagonal().setOnes();
  Eigen::VectorXd sigma(8);
  sigma << 0.5, 0.6, 1, 1, 1e-3, 2e-3, 1e-4, 1e-4;
  const Eigen::MatrixXd covariance =
      sigma.asDiagonal() * root * root.transpose() * sigma.asDiagonal();
  network.lenses = {{0, std::get<Camera>(network.cameras[0].lens).intrinsics(), covariance}};
  const NetworkSolution calibrated = SolveNetwork(&network);
  EXPECT_EQ(calibrated.redundancy, alone.redundancy + 7);
  EXPECT_NEAR(calibrated.redundancy_numbers.sum(), calibrated.redundancy, 1e-6);
  const Eigen::MatrixXd information = lens_cofactor(calibrated).inverse();
  const Eigen::MatrixXd expected =
      lens_cofactor(alone).inverse() + covariance.topLeftCorner<7, 7>().inverse();
  EXPECT_LT((information - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-5);
}

// A lens known as well as nothing is a lens adjusted; one known exactly adds nothing.
TEST(SolveNetwork, ConsideredLensAddsWhatItsErrorWouldDo) {
  const Network truth = MakeRandomNetwork(9);
  Network network = truth;
  Eigen::VectorXd sigma(8);
  sigma << 2, 2, 2, 2, 1e-3, 1e-3, 1e-4, 1e-4;
  network.cameras[0].calibration_covariance = sigma.cwiseAbs2().asDiagonal();
  const NetworkSolution solution = SolveNetwork(&network);
  // The same change of the lens, made: the pose moves as the sensitivity says.
  Network changed = truth;
  const auto& lens = std::get<Camera>(truth.cameras[0].lens);
  std::vector<double> intrinsics = lens.intrinsics();
  intrinsics[0] += 0.5;
  intrinsics[1] += 0.5;
  intrinsics[2] -= 0.3;
  changed.cameras[0].lens = Camera(lens.lens_model(), intrinsics, lens.width(), lens.height());
  SolveNetwork(&changed);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(8);
  step.head<3>() = Eigen::Vector3d(0.5, 0.5, -0.3);
  const Eigen::VectorXd moved = solution.lens_sensitivity[0] * step;
  const Eigen::Vector3d center = changed.photos[1].center - network.photos[1].center;
  EXPECT_LT((center - moved.segment<3>(*solution.columns.center[1])).norm(), 0.02 * center.norm());
}

}  // namespace
}  // namespace insitu
