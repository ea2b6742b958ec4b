// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/solve_network.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calibration/error.h"
#include "reconstruction/datum.h"
#include "reconstruction/lens_residual.h"
#include "reconstruction/network_problem.h"

namespace insitu {
namespace {

std::vector<Eigen::Vector3d> Positions(const Network& network) {
  std::vector<Eigen::Vector3d> positions;
  for (const NetworkPoint& point : network.points) positions.push_back(point.position);
  return positions;
}

std::vector<Unknown> UnknownsOf(const NetworkColumns& columns, const std::vector<int>& list) {
  std::vector<Unknown> unknowns;
  std::set<std::pair<Unknown::Kind, int>> named;
  for (const int column : list) {
    const Unknown& unknown = columns.unknowns[column];
    if (named.insert({unknown.kind, unknown.index}).second) unknowns.push_back(unknown);
  }
  return unknowns;
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
  if (!cofactor) throw RankDefect(UnknownsOf(solution.columns, UndeterminedColumns(normal)));
  if (is_free) {
    cofactor->ChangeDatum(solution.datum.motions,
                          InnerConstraints(network, solution.columns, solution.datum));
  }
  return *std::move(cofactor);
}

// d residuals / d parameters of one camera's lens, over sigma.
Eigen::MatrixXd LensJacobian(const Network& network, const NetworkSolution& solution, int camera) {
  const Lens& lens = network.cameras[camera].lens;
  const std::vector<double> parameters = LensParameters(lens);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(solution.rows.size()),
                                                   static_cast<Eigen::Index>(parameters.size()));
  for (size_t row = 0; row < solution.rows.size(); ++row) {
    if (solution.rows[row].kind != ObservationKind::kMark || solution.rows[row].component) continue;
    const MarkObservation& mark = network.marks[solution.rows[row].index];
    const NetworkPhoto& photo = network.photos[mark.photo];
    if (photo.camera != camera) continue;
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_parameters;
    LensDerivatives derivatives;
    derivatives.by_parameters = &by_parameters;
    INSITU_CHECK(
        LensResidual(lens, parameters.data(),
                     photo.cam_from_local * (network.points[mark.point].position - photo.center),
                     mark.pixel, &residual, derivatives));
    jacobian.middleRows<2>(static_cast<Eigen::Index>(row)) = by_parameters / mark.sigma_px;
  }
  return jacobian;
}

// How the solution would move with the lens: dx/dl = -Q A^T P B. ["Consider" parameters:
// Tapley, Schutz & Born, Statistical Orbit Determination, 2004, ch. 6]
std::vector<Eigen::MatrixXd> LensSensitivity(const Network& network,
                                             const NetworkSolution& solution) {
  std::vector<Eigen::MatrixXd> sensitivity;
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    sensitivity.emplace_back();
    if (network.cameras[i].calibration_covariance.size() == 0 || solution.columns.camera[i]) {
      continue;
    }
    const Eigen::MatrixXd by_lens = LensJacobian(network, solution, static_cast<int>(i));
    sensitivity.back() = -solution.cofactor.Times(solution.jacobian.transpose() * by_lens);
  }
  return sensitivity;
}

}  // namespace

RankDefect::RankDefect(std::vector<Unknown> unknowns_in)
    : std::runtime_error("the observations do not determine every unknown"),
      unknowns(std::move(unknowns_in)) {}

NetworkSolution SolveNetwork(Network* network, const SolveOptions& options) {
  const std::vector<Eigen::Vector3d> start = Positions(*network);
  NetworkProblem problem(network);
  const ceres::Solver::Summary summary = problem.Solve(options);
  if (!summary.IsSolutionUsable()) throw NoSolution(summary.message);

  NetworkSolution solution;
  solution.is_converged = summary.termination_type == ceres::CONVERGENCE;
  solution.iterations = static_cast<int>(summary.iterations.size()) - 1;
  solution.columns = problem.columns();
  solution.rows = problem.rows();
  solution.datum = FindDatum(*network, solution.columns, problem.Linearize().jacobian);
  if (solution.datum.defect() > 0) {
    MoveToStart(solution.columns, start, network, &solution.datum);
  }
  NetworkProblem::Linearization linear = problem.Linearize();
  solution.jacobian = std::move(linear.jacobian);
  solution.sigmas = Eigen::Map<const Eigen::VectorXd>(
      problem.sigmas().data(), static_cast<Eigen::Index>(problem.sigmas().size()));
  solution.residuals = linear.residuals.cwiseProduct(solution.sigmas);
  solution.square_sum = linear.residuals.squaredNorm();
  solution.observations = static_cast<int>(solution.jacobian.rows());
  solution.unknowns = static_cast<int>(solution.jacobian.cols());
  solution.redundancy = solution.observations - solution.unknowns + solution.datum.defect();
  if (solution.redundancy > 0) {
    solution.sigma0 = std::sqrt(solution.square_sum / solution.redundancy);
  }
  solution.cofactor = CofactorOf(*network, solution);
  solution.redundancy_numbers = RedundancyNumbers(solution.jacobian, solution.cofactor);
  solution.lens_sensitivity = LensSensitivity(*network, solution);
  return solution;
}

Eigen::MatrixXd Covariance(const Network& network, const NetworkSolution& solution, int row,
                           int rows, int column, int columns) {
  Eigen::MatrixXd covariance =
      solution.sigma0 * solution.sigma0 * solution.cofactor.Block(row, rows, column, columns);
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    const Eigen::MatrixXd& by_lens = solution.lens_sensitivity[i];
    if (by_lens.size() == 0) continue;
    covariance += by_lens.middleRows(row, rows) * network.cameras[i].calibration_covariance *
                  by_lens.middleRows(column, columns).transpose();
  }
  return covariance;
}

}  // namespace insitu
