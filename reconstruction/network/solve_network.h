// SPDX-License-Identifier: GPL-3.0-or-later
// The joint least-squares adjustment of a Network, by Ceres, and its statistics from a last pass
// without robust loss.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reconstruction/network/network.h"
#include "reconstruction/network/statistics.h"

namespace insitu {

// One scalar equation: a component of an observation.
enum class ObservationKind {
  kMark,
  kEdge,
  kControl,
  kCenter,
  kLens,
  kPlane,
  kDirection,
  kDistance,
  kHeight,
  kAngle,
};
struct ObservationRow {
  ObservationKind kind;
  int index = 0;      // into the kind's list in the network
  int component = 0;  // x, y, z or first, second; of a lens the free parameter, given those before
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

// What the observations leave free of position, orientation and scale.
struct Datum {
  Eigen::MatrixXd motions;  // unknowns x defect: the motions that no observation sees; 0..7 columns
  std::array<bool, 7> is_free{};  // which of tx ty tz rx ry rz scale take part in them

  int defect() const { return static_cast<int>(motions.cols()); }
};

struct NetworkSolution {
  bool is_converged = false;
  int iterations = 0;

  NetworkColumns columns;
  Datum datum;  // where it is free: inner constraints over all points, about the start values
  int observations = 0, unknowns = 0, redundancy = 0;  // redundancy = n - u + datum.defect()
  double square_sum = 0;                               // sum (v / sigma)^2
  double sigma0 = 1;  // a posteriori, a priori 1; 1 without redundancy

  // By row. residual = adjusted - observed, in the unit of sigma.
  std::vector<ObservationRow> rows;
  Eigen::VectorXd residuals, sigmas, redundancy_numbers;

  Jacobian jacobian;         // rows over sigma
  SelectedInverse cofactor;  // of the unknowns, unit weight; covariance = sigma0^2 cofactor
  // Per camera: d unknowns / d considered parameters (count x parameters), else empty.
  std::vector<Eigen::MatrixXd> lens_sensitivity;
};

// The observations do not determine these.
class RankDefect : public std::runtime_error {
 public:
  struct Column {
    Unknown unknown;
    int component = 0;  // among the unknown's columns
  };
  explicit RankDefect(std::vector<Column> columns_in);
  std::vector<Column> columns;  // at least one
};

// The solver could not start or diverges: a point behind its camera, no finite value.
class NoSolution : public std::runtime_error {
 public:
  explicit NoSolution(const std::string& what, std::optional<ObservationRow> row_in = {})
      : std::runtime_error(what), row(row_in) {}
  std::optional<ObservationRow> row;  // the observation that has no value
};

struct SolveOptions {
  int max_iterations = 100;
};

// Moves the network's unknowns to the least-squares solution.
// Throws RankDefect if the observations do not determine every unknown but for the datum;
// NoSolution.
NetworkSolution SolveNetwork(Network* network, const SolveOptions& options = {});

// Covariance between unknowns of consecutive columns, scaled by sigma0^2, with what the considered
// lens parameters add. Both must occur together in some observation, or be of one unknown.
Eigen::MatrixXd Covariance(const Network& network, const NetworkSolution& solution, int row,
                           int rows, int column, int columns);

// The same of linear functions of any unknowns: one a row, by column.
Eigen::MatrixXd CovarianceOf(const Network& network, const NetworkSolution& solution,
                             const Eigen::MatrixXd& by_unknowns);

}  // namespace insitu
