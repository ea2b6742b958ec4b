// SPDX-License-Identifier: GPL-3.0-or-later
// A network as a linear system: what its rows and columns belong to, what stays free, and why there
// is no solution.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace insitu {

// One scalar equation: a component of an observation.
struct ObservationRow {
  enum class Kind {
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
  Kind kind;
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

// What holds position, orientation and scale is worth, a priori and were the network rigid:
// standard deviations; nullopt: nothing holds it.
struct DatumWorth {
  std::optional<double> plan, height;   // [m], of the points' middle
  std::optional<double> tilt, heading;  // [rad]
  std::optional<double> scale;          // relative
};

// The observations do not determine these.
class RankDefect : public std::runtime_error {
 public:
  struct Column {
    Unknown unknown;
    int component = 0;  // among the unknown's columns
  };
  explicit RankDefect(std::vector<Column> columns_in)
      : std::runtime_error("the observations do not determine every unknown"),
        columns(std::move(columns_in)) {}
  std::vector<Column> columns;  // at least one
};

// The solver could not start or diverges: a point behind its camera, no finite value.
class NoSolution : public std::runtime_error {
 public:
  explicit NoSolution(const std::string& what, std::optional<ObservationRow> row_in = {})
      : std::runtime_error(what), row(row_in) {}
  std::optional<ObservationRow> row;  // the observation that has no value
};

}  // namespace insitu
