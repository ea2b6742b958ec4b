// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns of the joint adjustment and the system of observations over them.
#pragma once

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sphere_manifold.h>

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/adjustment.h"
#include "reconstruction/start_values.h"
#include "reconstruction/statistics.h"

namespace insitu {

struct NetworkPose {
  std::string photo;
  Camera camera;
  Eigen::Quaterniond cam_from_local;
  Eigen::Vector3d center;  // [m], local
};

// The points x with normal . (x - centroid) = offset; the centroid is fixed.
struct NetworkPlane {
  std::string polygon;
  std::vector<std::string> vertices;
  Eigen::Vector3d normal;    // unit, outward
  Eigen::Vector3d centroid;  // [m], local
  double offset = 0;         // [m]
};

// All coordinates are world minus `origin`, so that national grids lose nothing.
struct Network {
  Eigen::Vector3d origin;
  std::vector<NetworkPose> poses;
  std::map<std::string, Eigen::Vector3d> points;
  std::vector<NetworkPlane> planes;  // of the polygons with four vertices or more
  std::optional<Eigen::Vector3d> sun, zenith;
};

// Throws InputError at a direction pair whose points coincide or that contradicts the others.
Network MakeNetwork(const Survey& survey, const StartValues& start);

// What an unknown belongs to, to name it.
struct Unknown {
  enum class Kind { kPhoto, kPoint, kPolygon, kSun, kZenith };
  Kind kind;
  std::string name;
};

// The observation equations over a network, which must outlive it and not move.
class AdjustmentProblem {
 public:
  AdjustmentProblem(const Survey& survey, const AdjustmentOptions& options, Network& network);

  // Moves the network's unknowns to the least-squares solution.
  struct Termination {
    bool usable = false, converged = false;
    int iterations = 0;
  };
  Termination Solve();

  // At the present values. The columns of a pose are its left rotation increment [rad] and its
  // centre [m]; those of a unit vector its two tangents.
  struct Linearization {
    std::vector<ObservationResidual> rows;  // all but `redundancy`
    Eigen::VectorXd residuals;              // in sigmas
    Jacobian jacobian;
  };
  Linearization Linearize();

  // First column of a parameter block, given its address in the network.
  int ColumnOf(const double* block) const { return column_of_block_.at(block); }
  // What a column belongs to.
  const Unknown& UnknownOf(int column) const { return unknown_of_column_[column]; }

 private:
  void AddBlock(double* block, int size, ceres::Manifold* manifold, const Unknown& unknown);
  void AddUnknowns();
  void AddMarks(const Survey& survey);
  void AddControl(const Survey& survey);
  void AddPlanes(double sigma);
  void AddPairs(const std::vector<DirectionPair>& pairs, const std::string& group, double sigma,
                Eigen::Vector3d* direction);
  void AddObservation(ceres::CostFunction* cost, const std::vector<double*>& blocks,
                      const std::vector<ObservationResidual>& rows);

  Network& network_;
  ceres::EigenQuaternionManifold quaternion_manifold_;
  ceres::SphereManifold<3> sphere_manifold_;
  ceres::Problem problem_;
  std::vector<double*> blocks_;
  std::map<const double*, int> column_of_block_;
  std::vector<Unknown> unknown_of_column_;
  std::vector<bool> is_half_angle_;  // by column: Ceres counts rotations in half angles
  std::vector<ceres::ResidualBlockId> observations_;
  std::vector<ObservationResidual> rows_;
};

}  // namespace insitu
