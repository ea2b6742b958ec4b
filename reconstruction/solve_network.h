// SPDX-License-Identifier: GPL-3.0-or-later
// The joint least-squares adjustment of a Network, by Ceres, and its statistics from a last pass
// without robust loss.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/network.h"
#include "reconstruction/statistics.h"

namespace insitu {

// One scalar equation: a component of an observation.
enum class ObservationKind {
  kMark,
  kEdge,
  kControl,
  kCenter,
  kPlane,
  kDirection,
  kDistance,
  kHeight,
  kAngle,
};
struct ObservationRow {
  ObservationKind kind;
  int index = 0;      // into the kind's list in the network
  int component = 0;  // x, y, z or first, second
};

// What a column of the system belongs to, to name it.
struct Unknown {
  enum class Kind { kCamera, kPhoto, kPoint, kPlane, kDirection };
  Kind kind;
  int index = 0;  // into the kind's list in the network
};

// The first column of each unknown; nullopt: not adjusted. Columns of a photo: left rotation
// increment [rad], centre [m]; of a plane: two tangents of its normal, offset; of a direction: two
// tangents; of a camera: its free parameters in their order.
struct NetworkColumns {
  std::vector<std::optional<int>> camera, rotation, center, point, plane, direction;
  int count = 0;
  std::vector<Unknown> unknowns;  // by column
};

// The seven motions of a free network: three translations, three rotations, scale.
struct DatumDefect {
  int defect = 0;  // of the observations, 0..7
  std::array<bool, 7> is_free{};  // tx ty tz rx ry rz scale: not held by any observation
};

struct NetworkSolution {
  bool is_converged = false;
  int iterations = 0;

  NetworkColumns columns;
  DatumDefect datum;  // where it is free: inner constraints over all points, about the start values
  int observations = 0, unknowns = 0, redundancy = 0;  // redundancy = n - u + datum.defect
  double square_sum = 0;  // sum (v / sigma)^2
  double sigma0 = 1;      // a posteriori, a priori 1; 1 without redundancy

  // By row. residual = adjusted - observed, in the unit of sigma.
  std::vector<ObservationRow> rows;
  Eigen::VectorXd residuals, sigmas, redundancy_numbers;

  Jacobian jacobian;         // rows over sigma; for what else one wants to know
  SelectedInverse cofactor;  // of the unknowns, unit weight; covariance = sigma0^2 cofactor
  // Per camera: d unknowns / d considered parameters (count x parameters), else empty.
  std::vector<Eigen::MatrixXd> lens_sensitivity;
};

struct SolveOptions {
  int max_iterations = 100;
};

// Moves the network's unknowns to the least-squares solution.
// Throws RankDefect if the observations do not determine every unknown but for the datum.
NetworkSolution SolveNetwork(Network* network, const SolveOptions& options = {});

}  // namespace insitu
