// SPDX-License-Identifier: GPL-3.0-or-later
// A network as a Ceres problem: its unknowns as parameter blocks, its observations as residuals.
#pragma once

#include <ceres/manifold.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <Eigen/Core>
#include <list>
#include <memory>
#include <vector>

#include "reconstruction/network/network.h"
#include "reconstruction/network/network_parameters.h"
#include "reconstruction/network/network_system.h"
#include "reconstruction/network/statistics.h"

namespace insitu {

// The network must outlive the problem; its lists must keep their lengths.
class NetworkProblem {
 public:
  explicit NetworkProblem(Network* network);

  // Keeps these columns, of photos, near their present values while solving: no observations, they
  // only stand for a datum that is free. `weights`: of one row over sigma, squared.
  void HoldPhotos(const std::vector<int>& columns, const std::vector<double>& weights);

  // Moves the network's unknowns to the least-squares solution.
  ceres::Solver::Summary Solve();

  const NetworkColumns& columns() const { return columns_; }
  const std::vector<ObservationRow>& rows() const { return rows_; }
  const std::vector<double>& sigmas() const { return sigmas_; }  // by row

  // At the present values; rows and residuals over sigma. Columns as NetworkColumns says.
  struct Linearization {
    Eigen::VectorXd residuals;
    Jacobian jacobian;
  };
  Linearization Linearize();  // throws NoSolution: a point behind its camera

 private:
  void AddUnknowns();
  void AddCameras();
  void AddObservations();
  void AddMarks();
  void AddEdges();
  void AddPositions();
  void AddLenses();
  void AddPlanesAndDirections();
  void AddConstraints();
  void AddAngle(int index);
  std::shared_ptr<ceres::ParameterBlockOrdering> Ordering();

  // Returns the block's first column.
  int AddBlock(double* block, int size, ceres::Manifold* manifold, const Unknown& unknown);
  // One row for each of `sigmas`.
  void AddResidual(ObservationRow::Kind kind, int index, ceres::CostFunction* cost,
                   const std::vector<double*>& blocks, const std::vector<double>& sigmas);
  [[noreturn]] void ThrowNoValue() const;  // names the observation that cannot be evaluated

  Network& network_;
  NetworkParameters values_;
  ceres::EigenQuaternionManifold quaternion_manifold_;
  ceres::SphereManifold<3> sphere_manifold_;
  std::list<ceres::SubsetManifold> lens_manifolds_;
  ceres::Problem problem_;
  std::vector<double*> blocks_;
  std::vector<ceres::ResidualBlockId> residual_blocks_;
  NetworkColumns columns_;
  std::vector<ObservationRow> rows_;
  std::vector<double> sigmas_;
};

}  // namespace insitu
