// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/datum.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "reconstruction/network/unit_tangents.h"

namespace insitu {
namespace {

constexpr int kMotions = 7;                  // tx ty tz rx ry rz scale
constexpr double kFreeSingularValue = 1e-9;  // of motions scaled to 1
constexpr double kFixedSigma = 1e-4;         // [m], of what is taken as exact
constexpr double kNothing = 1e-13;           // of weights: rounding

using PointMotions = Eigen::Matrix<double, 3, kMotions>;

// Middle and mean radius of the points: about it the motions hardly correlate.
struct Extent {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 1;
};

Extent ExtentOf(const Network& network) {
  Extent extent;
  const double count = static_cast<double>(network.points.size());
  for (const NetworkPoint& point : network.points) extent.middle += point.position / count;
  double squares = 0;
  for (const NetworkPoint& point : network.points) {
    squares += (point.position - extent.middle).squaredNorm() / count;
  }
  if (squares > 0) extent.radius = std::sqrt(squares);
  return extent;
}

// dx = radius (t + w cross y + s y), with y = (x - middle) / radius.
PointMotions MotionsOf(const Extent& extent, const Eigen::Vector3d& x) {
  const Eigen::Vector3d y = x - extent.middle;
  PointMotions motions;
  motions << extent.radius * Eigen::Matrix3d::Identity(), -CrossMatrix(y), y;
  return motions;
}

// Two tangents of a turned unit vector.
Eigen::Matrix<double, 2, 3> TurnOfUnit(const Eigen::Vector3d& unit) {
  const Eigen::Matrix<double, 3, 2> unit_from_tangent = TangentsOf(unit);
  return (unit_from_tangent.transpose() * unit_from_tangent).inverse() *
         unit_from_tangent.transpose() * -CrossMatrix(unit);
}

Eigen::MatrixXd SimilarityMotions(const Network& network, const NetworkColumns& columns) {
  const Extent extent = ExtentOf(network);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(columns.count, kMotions);
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const NetworkPhoto& photo = network.photos[i];
    g.block<3, 3>(*columns.rotation[i], 3) = -photo.cam_from_local.toRotationMatrix();
    if (columns.center[i]) g.middleRows<3>(*columns.center[i]) = MotionsOf(extent, photo.center);
  }
  for (size_t i = 0; i < network.points.size(); ++i) {
    if (!columns.point[i]) continue;
    g.middleRows<3>(*columns.point[i]) = MotionsOf(extent, network.points[i].position);
  }
  for (size_t i = 0; i < network.planes.size(); ++i) {
    const NetworkPlane& plane = network.planes[i];
    g.block<2, 3>(*columns.plane[i], 3) = TurnOfUnit(plane.normal);
    // A point of the plane at rest in (n, offset): its own motion along n, less the turn of n.
    const Eigen::Vector3d foot = plane.centroid + plane.offset * plane.normal;
    g.row(*columns.plane[i] + 2) = plane.normal.transpose() * MotionsOf(extent, foot);
    g.block<1, 3>(*columns.plane[i] + 2, 3) +=
        (foot - plane.centroid).transpose() * -CrossMatrix(plane.normal);
  }
  for (size_t i = 0; i < network.directions.size(); ++i) {
    if (!columns.direction[i]) continue;
    g.block<2, 3>(*columns.direction[i], 3) = TurnOfUnit(network.directions[i].unit);
  }
  return g;
}

// How what is fixed would move: three rows a fixed point or centre.
std::vector<PointMotions> MotionsOfFixed(const Network& network) {
  const Extent extent = ExtentOf(network);
  std::vector<PointMotions> motions;
  for (const NetworkPoint& point : network.points) {
    if (point.is_fixed) motions.push_back(MotionsOf(extent, point.position) / extent.radius);
  }
  for (const NetworkPhoto& photo : network.photos) {
    if (photo.is_center_fixed) motions.push_back(MotionsOf(extent, photo.center) / extent.radius);
  }
  return motions;
}

// The fixed direction that an observation refers to.
std::optional<Eigen::Vector3d> FixedUnit(const Network& network, const ObservationRow& row) {
  const auto unit_of = [&](int direction) -> std::optional<Eigen::Vector3d> {
    if (!network.directions[direction].is_fixed) return std::nullopt;
    return network.directions[direction].unit;
  };
  if (row.kind == ObservationRow::Kind::kDirection) {
    return unit_of(network.along_directions[row.index].direction);
  }
  if (row.kind == ObservationRow::Kind::kHeight)
    return unit_of(network.heights[row.index].direction);
  if (row.kind != ObservationRow::Kind::kAngle) return std::nullopt;
  const AngleObservation& angle = network.angles[row.index];
  for (const UnitReference& reference : {angle.first, angle.second}) {
    const auto* unit = std::get_if<DirectionUnit>(&reference);
    if (unit && unit_of(unit->direction)) return unit_of(unit->direction);
  }
  return std::nullopt;
}

bool HoldsDatum(const Network& network, const ObservationRow& row) {
  switch (row.kind) {
    case ObservationRow::Kind::kControl:
    case ObservationRow::Kind::kCenter:
    case ObservationRow::Kind::kDistance:
      return true;
    case ObservationRow::Kind::kHeight:
      return network.heights[row.index].height != 0;
    default:
      return false;
  }
}

// Rows over sigma of what holds the datum; if they are to be scaled, so that each would be about 1
// without cancellation.
Eigen::MatrixXd HeldMotions(const Network& network, const std::vector<ObservationRow>& rows,
                            const Jacobian& jacobian, const Eigen::MatrixXd& g,
                            bool is_scaled = true) {
  const std::vector<PointMotions> fixed = MotionsOfFixed(network);
  const double fixed_weight = is_scaled ? 1 : ExtentOf(network).radius / kFixedSigma;
  std::vector<Eigen::Matrix<double, 1, kMotions>> held;
  for (const PointMotions& motions : fixed) {
    for (int axis = 0; axis < 3; ++axis) held.emplace_back(fixed_weight * motions.row(axis));
  }
  for (int row = 0; row < static_cast<int>(rows.size()); ++row) {
    const bool holds_datum = HoldsDatum(network, rows[row]);
    const std::optional<Eigen::Vector3d> unit = FixedUnit(network, rows[row]);
    if (!holds_datum && !unit) continue;
    Eigen::Matrix<double, 1, kMotions> seen = Eigen::Matrix<double, 1, kMotions>::Zero();
    double magnitude = 0;
    for (Jacobian::InnerIterator entry(jacobian, row); entry; ++entry) {
      seen += entry.value() * g.row(entry.col());
      magnitude += std::abs(entry.value()) * g.row(entry.col()).norm();
    }
    // What is observed as 0 sees neither shift nor scale but by its misclosure, and nothing sees a
    // turn about the fixed direction itself.
    if (!holds_datum) seen.head<3>().setZero(), seen[6] = 0;
    if (unit) seen.segment<3>(3) -= seen.segment<3>(3).dot(*unit) * unit->transpose();
    if (magnitude > 0) held.emplace_back(is_scaled ? seen / magnitude : seen);
  }
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(held.size()), kMotions);
  for (size_t i = 0; i < held.size(); ++i) matrix.row(static_cast<Eigen::Index>(i)) = held[i];
  return matrix;
}

// Seven small amounts as a motion: x -> middle + (1 + s) R (x - middle) + radius t.
void Move(const Extent& extent, const Eigen::Matrix<double, kMotions, 1>& amounts,
          Network* network) {
  const Eigen::Vector3d shift = extent.radius * amounts.head<3>(), turn = amounts.segment<3>(3);
  const double factor = 1 + amounts[6];
  const Eigen::Quaterniond rotation(
      Eigen::AngleAxisd(turn.norm(), turn.norm() > 0 ? Eigen::Vector3d(turn.normalized())
                                                     : Eigen::Vector3d::UnitX()));
  const auto moved = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return extent.middle + factor * (rotation * (x - extent.middle)) + shift;
  };
  for (NetworkPhoto& photo : network->photos) {
    photo.center = moved(photo.center);
    photo.cam_from_local = (photo.cam_from_local * rotation.conjugate()).normalized();
  }
  for (NetworkPoint& point : network->points) point.position = moved(point.position);
  for (NetworkPlane& plane : network->planes) {
    const Eigen::Vector3d foot = moved(plane.centroid + plane.offset * plane.normal);
    plane.normal = (rotation * plane.normal).normalized();
    plane.offset = plane.normal.dot(foot - plane.centroid);
  }
  for (NetworkDirection& direction : network->directions) {
    if (!direction.is_fixed) direction.unit = (rotation * direction.unit).normalized();
  }
}

bool IsPointColumn(const NetworkColumns& columns, int column) {
  return columns.unknowns[column].kind == Unknown::Kind::kPoint;
}

}  // namespace

Datum FindDatum(const Network& network, const NetworkColumns& columns,
                const std::vector<ObservationRow>& rows, const Jacobian& jacobian) {
  const Eigen::MatrixXd g = SimilarityMotions(network, columns);
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(kMotions, kMotions);
  const Eigen::MatrixXd seen = HeldMotions(network, rows, jacobian, g);
  held.conservativeResize(kMotions + seen.rows(), kMotions);
  held.bottomRows(seen.rows()) = seen;
  const SingularValues singular = SingularValuesOf(held);
  const auto defect = static_cast<int>((singular.values.array() < kFreeSingularValue).count());
  const Eigen::MatrixXd free = singular.right.rightCols(defect);
  Datum datum;
  datum.motions = g * free;
  for (int k = 0; k < kMotions && defect > 0; ++k) datum.is_free[k] = free.row(k).norm() > 1e-6;
  for (int k = 0; k < defect; ++k) datum.motions.col(k).normalize();
  return datum;
}

DatumWorth FindDatumWorth(const Network& network, const NetworkColumns& columns,
                          const std::vector<ObservationRow>& rows, const Jacobian& jacobian) {
  const Eigen::MatrixXd held =
      HeldMotions(network, rows, jacobian, SimilarityMotions(network, columns), false);
  const Eigen::MatrixXd normal = held.transpose() * held;
  const SymmetricEigen<Eigen::Dynamic> eigen = EigenOfSymmetric(normal);
  const double least = kNothing * std::max(eigen.values[kMotions - 1], 1e-300);
  // Of one of the seven, or nullopt where a motion that nothing holds takes part in it.
  const auto variance = [&](int motion) -> std::optional<double> {
    double sum = 0;
    for (int k = 0; k < kMotions; ++k) {
      const double share = std::pow(eigen.vectors(motion, k), 2);
      if (eigen.values[k] > least) {
        sum += share / eigen.values[k];
      } else if (share > 1e-6) {
        return std::nullopt;
      }
    }
    return sum;
  };
  const auto worst = [&](int first, int second, double unit) -> std::optional<double> {
    const auto a = variance(first), b = variance(second);
    if (!a || !b) return std::nullopt;
    return unit * std::sqrt(std::max(*a, *b));
  };
  const double radius = ExtentOf(network).radius;
  return {worst(0, 1, radius), worst(2, 2, radius), worst(3, 4, 1), worst(5, 5, 1), worst(6, 6, 1)};
}

std::vector<int> DatumPins(const Network& network, const NetworkColumns& columns,
                           const Datum& datum) {
  const double radius = ExtentOf(network).radius;
  Eigen::MatrixXd photos = Eigen::MatrixXd::Zero(datum.defect(), columns.count);
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const int rotation = *columns.rotation[i];
    photos.middleCols<3>(rotation) = radius * datum.motions.middleRows<3>(rotation).transpose();
    if (!columns.center[i]) continue;
    photos.middleCols<3>(*columns.center[i]) =
        datum.motions.middleRows<3>(*columns.center[i]).transpose();
  }
  const Eigen::VectorXi order = PivotOrder(photos);
  return {order.begin(), order.begin() + datum.defect()};
}

Eigen::MatrixXd InnerConstraints(const NetworkColumns& columns, const Datum& datum) {
  Eigen::MatrixXd b = datum.motions;
  for (int column = 0; column < columns.count; ++column) {
    if (!IsPointColumn(columns, column)) b.row(column).setZero();
  }
  return b;
}

void MoveToStart(const NetworkColumns& columns, const std::vector<Eigen::Vector3d>& start_points,
                 Network* network, Datum* datum) {
  constexpr int kSteps = 5;  // each squares the remaining error
  // Fixed points and centres take part in no free motion, so moving them is rounding: put back.
  const Network before = *network;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixXd g = SimilarityMotions(*network, columns);
    // The free motions are combinations of the seven; these are their amounts.
    const Eigen::MatrixXd amounts = SolveLeastSquares(g, datum->motions).x;
    const Eigen::MatrixXd b = InnerConstraints(columns, *datum);
    Eigen::VectorXd away = Eigen::VectorXd::Zero(columns.count);
    for (size_t i = 0; i < network->points.size(); ++i) {
      if (!columns.point[i]) continue;
      away.segment<3>(*columns.point[i]) = network->points[i].position - start_points[i];
    }
    const Eigen::VectorXd back = SolveLeastSquares(b, away).x;
    Move(ExtentOf(*network), -amounts * back, network);
    datum->motions = SimilarityMotions(*network, columns) * amounts;
  }
  for (size_t i = 0; i < network->points.size(); ++i) {
    if (before.points[i].is_fixed) network->points[i].position = before.points[i].position;
  }
  for (size_t i = 0; i < network->photos.size(); ++i) {
    if (before.photos[i].is_center_fixed) network->photos[i].center = before.photos[i].center;
  }
}

}  // namespace insitu
