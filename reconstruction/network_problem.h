// SPDX-License-Identifier: GPL-3.0-or-later
// A network as a Ceres problem: its unknowns as parameter blocks, its observations as residuals.
#pragma once

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <Eigen/Core>
#include <list>
#include <vector>

#include "reconstruction/solve_network.h"

namespace insitu {

// The network must outlive the problem and not move.
class NetworkProblem {
 public:
  explicit NetworkProblem(Network* network);

  // Keeps the distance between two points as it is while solving; no observation.
  void HoldDistance(int from, int to);

  // Moves the network's unknowns to the least-squares solution.
  ceres::Solver::Summary Solve(const SolveOptions& options);

  const NetworkColumns& columns() const { return columns_; }
  const std::vector<ObservationRow>& rows() const { return rows_; }
  const std::vector<double>& sigmas() const { return sigmas_; }  // by row

  // At the present values; rows and residuals over sigma. Columns as NetworkColumns says.
  struct Linearization {
    Eigen::VectorXd residuals;
    Jacobian jacobian;
  };
  Linearization Linearize();

 private:
  void AddUnknowns();
  void AddCameras();
  void AddObservations();
  void AddMarks();
  void AddEdges();
  void AddPositions();
  void AddPlanesAndDirections();
  void AddConstraints();
  void AddAngle(int index);

  // Returns the block's first column.
  int AddBlock(double* block, int size, ceres::Manifold* manifold, const Unknown& unknown);
  // One row for each of `sigmas`.
  void AddResidual(ObservationKind kind, int index, ceres::CostFunction* cost,
                   const std::vector<double*>& blocks, const std::vector<double>& sigmas);
  double* Rotation(int photo);
  double* Center(int photo);
  double* Point(int point);
  double* Unit(const UnitReference& reference);

  Network& network_;
  ceres::EigenQuaternionManifold quaternion_manifold_;
  ceres::SphereManifold<3> sphere_manifold_;
  std::list<ceres::SubsetManifold> lens_manifolds_;
  std::vector<std::vector<double>> lens_parameters_;  // by camera
  ceres::Problem problem_;
  std::vector<double*> blocks_;
  std::vector<ceres::ResidualBlockId> residual_blocks_;
  NetworkColumns columns_;
  std::vector<ObservationRow> rows_;
  std::vector<double> sigmas_;
};

}  // namespace insitu
