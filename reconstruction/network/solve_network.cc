// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/solve_network.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/lens/lens_residual.h"
#include "reconstruction/network/datum.h"
#include "reconstruction/network/mark_correlation.h"
#include "reconstruction/network/network_problem.h"
#include "reconstruction/network/variance_factor.h"

namespace insitu {
namespace {

std::vector<Eigen::Vector3d> Positions(const Network& network) {
  std::vector<Eigen::Vector3d> positions;
  for (const NetworkPoint& point : network.points) positions.push_back(point.position);
  return positions;
}

std::vector<RankDefect::Column> ColumnsOf(const NetworkColumns& columns,
                                          const std::vector<int>& list) {
  std::vector<RankDefect::Column> named;
  for (const int column : list) {
    const Unknown& unknown = columns.unknowns[column];
    int component = 0;
    while (component < column) {
      const Unknown& before = columns.unknowns[column - component - 1];
      if (before.kind != unknown.kind || before.index != unknown.index) break;
      ++component;
    }
    named.push_back({unknown, component});
  }
  return named;
}

// Without it the steps wander, and pseudo-observations in metres would shrink a network whose scale
// is free.
void HoldFreeDatum(const Network& network, const NetworkProblem::Linearization& linear,
                   NetworkProblem* problem) {
  constexpr double kStiffness = 1e4;  // against all observations of the coordinate
  const Datum datum = FindDatum(network, problem->columns(), problem->rows(), linear.jacobian);
  if (datum.defect() == 0) return;
  const std::vector<int> pins = DatumPins(network, problem->columns(), datum);
  const Eigen::VectorXd diagonal = NormalMatrix(linear.jacobian).diagonal();
  std::vector<double> weights;
  for (const int pin : pins) weights.push_back(kStiffness * diagonal[pin]);
  problem->HoldPhotos(pins, weights);
}

// The cofactor matrix in the datum of the inner constraints, if any is free.
SelectedInverse CofactorOf(const Network& network, const NetworkSolution& solution) {
  Eigen::SparseMatrix<double> normal = NormalMatrix(solution.jacobian);
  const bool is_free = solution.datum.defect() > 0;
  if (is_free) {
    for (const int pin : DatumPins(network, solution.columns, solution.datum)) {
      normal.coeffRef(pin, pin) *= 2;
    }
  }
  std::optional<SelectedInverse> cofactor = SelectedInverse::Of(normal);
  if (!cofactor) throw RankDefect(ColumnsOf(solution.columns, UndeterminedColumns(normal)));
  if (is_free) {
    cofactor->ChangeDatum(solution.datum.motions,
                          InnerConstraints(solution.columns, solution.datum));
  }
  return *std::move(cofactor);
}

bool IsConsidered(const Network& network, const NetworkColumns& columns, size_t camera) {
  return network.cameras[camera].calibration_covariance.size() > 0 && !columns.camera[camera];
}

// How the solution would move with the lens: dx/dl = -Q A^T P B. ["Consider" parameters:
// Tapley, Schutz & Born, Statistical Orbit Determination, 2004, ch. 6]
std::vector<Eigen::MatrixXd> LensSensitivity(const Network& network,
                                             const NetworkSolution& solution) {
  std::vector<Eigen::MatrixXd> sensitivity(network.cameras.size());
  Network free = network;
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    if (!IsConsidered(network, solution.columns, i)) continue;
    free.cameras[i].is_free.assign(LensParameters(network.cameras[i].lens).size(), true);
  }
  NetworkProblem problem(&free);
  const Eigen::SparseMatrix<double> jacobian = problem.Linearize().jacobian;
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    if (!IsConsidered(network, solution.columns, i)) continue;
    const Eigen::MatrixXd by_lens = jacobian.middleCols(
        *problem.columns().camera[i], static_cast<Eigen::Index>(free.cameras[i].is_free.size()));
    sensitivity[i] = -solution.cofactor.Times(solution.jacobian.transpose() * by_lens);
  }
  return sensitivity;
}

// To the minimum, with what holds a free datum meanwhile.
ceres::Solver::Summary Minimize(const Network& network, NetworkProblem* problem) {
  HoldFreeDatum(network, problem->Linearize(), problem);
  ceres::Solver::Summary summary = problem->Solve();
  if (!summary.IsSolutionUsable()) throw NoSolution(summary.message);
  return summary;
}

bool HasTiePoints(const Network& network) {
  return std::ranges::any_of(network.points,
                             [](const NetworkPoint& point) { return point.is_tie_point; });
}

// The network is then solved with independent tie marks: near the solution with all others.
void FindTieMarkInflation(Network* network) {
  NetworkProblem problem(network);
  Minimize(*network, &problem);
  network->tie_mark_inflation =
      TieMarkInflation(*network, problem.rows(), problem.Linearize().residuals);
}

// Tie marks are weighted by their inflated sigma, but each alone errs by its own, by which it is
// judged.
void JudgeByOwnSigmas(const Network& network, NetworkSolution* solution) {
  const double inflation = network.tie_mark_inflation.value_or(1);
  if (inflation == 1) return;
  for (size_t row = 0; row < solution->rows.size(); ++row) {
    if (solution->rows[row].kind != ObservationRow::Kind::kMark) continue;
    const MarkObservation& mark = network.marks[solution->rows[row].index];
    if (!network.points[mark.point].is_tie_point) continue;
    const auto i = static_cast<Eigen::Index>(row);
    solution->sigmas[i] = mark.sigma_px;
    const double squared = std::pow(solution->residuals[i] / mark.sigma_px, 2);
    solution->square_sum += squared * (1 - 1 / inflation);
  }
}

// The minimum without its statistics; what solving it took is then free for them.
NetworkSolution SolutionOf(const std::vector<Eigen::Vector3d>& start, Network* network) {
  NetworkProblem problem(network);
  const ceres::Solver::Summary summary = Minimize(*network, &problem);
  NetworkProblem::Linearization linear = problem.Linearize();

  NetworkSolution solution;
  solution.is_converged = summary.termination_type == ceres::CONVERGENCE;
  solution.iterations = static_cast<int>(summary.iterations.size()) - 1;
  solution.columns = problem.columns();
  solution.rows = problem.rows();
  solution.datum = FindDatum(*network, solution.columns, solution.rows, linear.jacobian);
  solution.datum_worth = FindDatumWorth(*network, solution.columns, solution.rows, linear.jacobian);
  if (solution.datum.defect() > 0) {
    MoveToStart(solution.columns, start, network, &solution.datum);
    linear = problem.Linearize();
  }
  solution.jacobian.swap(linear.jacobian);
  solution.sigmas = Eigen::Map<const Eigen::VectorXd>(
      problem.sigmas().data(), static_cast<Eigen::Index>(problem.sigmas().size()));
  solution.residuals = linear.residuals.cwiseProduct(solution.sigmas);
  solution.square_sum = linear.residuals.squaredNorm();
  JudgeByOwnSigmas(*network, &solution);
  solution.observations = static_cast<int>(solution.jacobian.rows());
  solution.unknowns = static_cast<int>(solution.jacobian.cols());
  solution.redundancy = solution.observations - solution.unknowns + solution.datum.defect();
  if (solution.redundancy > 0) {
    solution.sigma0 = std::sqrt(solution.square_sum / solution.redundancy);
  }
  return solution;
}

}  // namespace

NetworkSolution SolveNetwork(Network* network) {
  const std::vector<Eigen::Vector3d> start = Positions(*network);
  if (!network->tie_mark_inflation && HasTiePoints(*network)) FindTieMarkInflation(network);
  NetworkSolution solution = SolutionOf(start, network);
  solution.cofactor = CofactorOf(*network, solution);
  solution.redundancy_numbers = RedundancyNumbers(solution.jacobian, solution.cofactor);
  solution.lens_sensitivity.resize(network->cameras.size());
  for (size_t i = 0; i < network->cameras.size(); ++i) {
    if (!IsConsidered(*network, solution.columns, i)) continue;
    solution.lens_sensitivity = LensSensitivity(*network, solution);
    break;
  }
  return solution;
}

Eigen::MatrixXd Covariance(const Network& network, const NetworkSolution& solution, int row,
                           int rows, int column, int columns) {
  Eigen::MatrixXd covariance = VarianceFactor(solution.sigma0, solution.redundancy) *
                               solution.cofactor.Block(row, rows, column, columns);
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    const Eigen::MatrixXd& by_lens = solution.lens_sensitivity[i];
    if (by_lens.size() == 0) continue;
    covariance += by_lens.middleRows(row, rows) * network.cameras[i].calibration_covariance *
                  by_lens.middleRows(column, columns).transpose();
  }
  return covariance;
}

Eigen::MatrixXd CovarianceOf(const Network& network, const NetworkSolution& solution,
                             const Eigen::MatrixXd& by_unknowns) {
  Eigen::MatrixXd covariance = VarianceFactor(solution.sigma0, solution.redundancy) * by_unknowns *
                               solution.cofactor.Times(by_unknowns.transpose());
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    if (solution.lens_sensitivity[i].size() == 0) continue;
    const Eigen::MatrixXd by_lens = by_unknowns * solution.lens_sensitivity[i];
    covariance += by_lens * network.cameras[i].calibration_covariance * by_lens.transpose();
  }
  return covariance;
}

}  // namespace insitu
