// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjusted_observations.h"

#include <Eigen/LU>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "calibration/lens/lens_residual.h"
#include "reconstruction/network/variance_factor.h"

namespace insitu {
namespace {

constexpr double kControlled = 1e-6;  // redundancy numbers below this control nothing

struct NamedRow {
  ObservationResidual residual;
  std::optional<int> point = {};  // whose position it bears on, if it is one point's
};

class RowNamer {
 public:
  explicit RowNamer(const SurveyNetwork& survey_network)
      : survey_network_(survey_network), network_(survey_network.network) {}

  NamedRow Name(const ObservationRow& row) const {
    using Kind = ObservationKind;
    const int axis = row.component;
    switch (row.kind) {
      case ObservationRow::Kind::kMark: {
        const MarkObservation& mark = network_.marks[row.index];
        return {{Kind::kImage, axis, Photo(mark.photo), Point(mark.point), mark.pixel[axis]},
                mark.point};
      }
      case ObservationRow::Kind::kEdge: {
        const EdgeObservation& edge = network_.edges[row.index];
        return {{Kind::kEdge, 0, Photo(edge.photo), Pair(edge.from, edge.to)}};
      }
      case ObservationRow::Kind::kControl: {
        const ControlObservation& control = network_.control[row.index];
        return {{Kind::kControl, axis, "", Point(control.point),
                 control.position[axis] + network_.origin[axis]},
                control.point};
      }
      case ObservationRow::Kind::kCenter: {
        const CenterObservation& center = network_.centers[row.index];
        return {{Kind::kCameraPosition, axis, Photo(center.photo), Photo(center.photo),
                 center.position[axis] + network_.origin[axis]}};
      }
      case ObservationRow::Kind::kLens:
        return {{Kind::kLens, 0, "", Parameter(row)}};
      case ObservationRow::Kind::kPlane:
        return OnPlane(network_.on_planes[row.index]);
      case ObservationRow::Kind::kDirection: {
        const DirectionObservation& pair = network_.along_directions[row.index];
        const bool is_sun = survey_network_.sun == pair.direction;
        return {{is_sun ? Kind::kSun : Kind::kZenith, 0, "", Pair(pair.from, pair.to)}};
      }
      case ObservationRow::Kind::kDistance: {
        const DistanceObservation& d = network_.distances[row.index];
        return {{Kind::kDistance, 0, "", Pair(d.from, d.to), d.distance}};
      }
      case ObservationRow::Kind::kHeight: {
        const HeightObservation& h = network_.heights[row.index];
        return {{Kind::kHeight, 0, "", Pair(h.from, h.to), h.height}};
      }
      case ObservationRow::Kind::kAngle:
        break;
    }
    const AngleObservation& angle = network_.angles[row.index];
    return {{Kind::kAngle, 0, "",
             Unit(angle.first) + (angle.is_parallel ? " parallel " : " perpendicular ") +
                 Unit(angle.second)}};
  }

 private:
  NamedRow OnPlane(const PlaneObservation& vertex) const {
    NamedRow named{{ObservationKind::kPlane, 0, "", Point(vertex.point)}, vertex.point};
    named.residual.polygon = network_.planes[vertex.plane].name;
    return named;
  }
  std::string Parameter(const ObservationRow& row) const {
    const NetworkCamera& camera = network_.cameras[network_.lenses[row.index].camera];
    const std::vector<std::string> names = LensParameterNames(camera.lens);
    int next = 0;
    for (size_t i = 0; i < names.size(); ++i) {
      if (camera.is_free[i] && next++ == row.component) return camera.name + " " + names[i];
    }
    throw CheckError(__FILE__, __LINE__, "the row is a free parameter's");
  }
  std::string Photo(int photo) const { return network_.photos[photo].name; }
  std::string Point(int point) const { return network_.points[point].name; }
  std::string Pair(int from, int to) const { return Point(from) + " " + Point(to); }
  std::string Unit(const UnitReference& unit) const {
    if (const auto* plane = std::get_if<PlaneNormal>(&unit)) {
      return network_.planes[plane->plane].name;
    }
    if (const auto* direction = std::get_if<DirectionUnit>(&unit)) {
      return network_.directions[direction->direction].name;
    }
    const auto& edge = std::get<EdgeUnit>(unit);
    return Pair(edge.from, edge.to);
  }

  const SurveyNetwork& survey_network_;
  const Network& network_;
};

// |Q a^T| of a point's coordinates, over sigma: how far an error of one sigma moves it [m].
double ShiftPerSigma(const NetworkSolution& solution, int row, int point_column) {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (Jacobian::InnerIterator entry(solution.jacobian, row); entry; ++entry) {
    for (int axis = 0; axis < 3; ++axis) {
      shift[axis] +=
          solution.cofactor.At(point_column + axis, static_cast<int>(entry.col())) * entry.value();
    }
  }
  return shift.norm();
}

// What the considered lenses add to a point's covariance [m^2].
Eigen::Matrix3d LensCovariance(const Network& network, const NetworkSolution& solution,
                               int point_column) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    if (solution.lens_sensitivity[i].size() == 0) continue;
    const Eigen::MatrixXd by_lens = solution.lens_sensitivity[i].middleRows(point_column, 3);
    covariance += by_lens * network.cameras[i].calibration_covariance * by_lens.transpose();
  }
  return covariance;
}

}  // namespace

std::vector<ObservationResidual> AdjustedObservations(const SurveyNetwork& survey_network,
                                                      const NetworkSolution& solution,
                                                      double significance) {
  const Network& network = survey_network.network;
  const RowNamer namer(survey_network);
  const double noncentrality = DetectableNoncentrality(significance);
  std::vector<ObservationResidual> residuals;
  residuals.reserve(solution.rows.size());
  for (int i = 0; i < static_cast<int>(solution.rows.size()); ++i) {
    auto [row, point] = namer.Name(solution.rows[i]);
    row.residual = solution.residuals[i];
    row.sigma = solution.sigmas[i];
    row.redundancy = solution.redundancy_numbers[i];
    row.is_tie_point = point && network.points[*point].is_tie_point;
    if (row.redundancy > kControlled) {
      const double root = std::sqrt(row.redundancy);
      row.w = row.residual / (row.sigma * root);
      row.detectable = noncentrality * row.sigma / root;
      row.external = noncentrality * std::sqrt(1 - row.redundancy) / root;
      if (point && solution.columns.point[*point]) {
        row.point_shift_m =
            ShiftPerSigma(solution, i, *solution.columns.point[*point]) * noncentrality / root;
      }
    }
    residuals.push_back(std::move(row));
  }
  return residuals;
}

std::string DatumInWords(const Datum& datum) {
  if (datum.defect() == 0) return "fixed by the survey";
  std::string free;
  const auto add = [&](const char* what, bool is_free) {
    if (is_free) free += (free.empty() ? "" : ", ") + std::string(what);
  };
  add("position", datum.is_free[0] || datum.is_free[1] || datum.is_free[2]);
  add("orientation", datum.is_free[3] || datum.is_free[4] || datum.is_free[5]);
  add("scale", datum.is_free[6]);
  return "free in " + std::to_string(datum.defect()) + " of 7 (" + free +
         "): coordinates are those of the start values as nearly as all points allow, and have no "
         "meaning beyond their shape" +
         (datum.is_free[6] ? "; lengths have no scale" : "");
}

std::vector<PointComparison> LeaveOneOut(const SurveyNetwork& survey_network,
                                         const NetworkSolution& solution) {
  const Network& network = survey_network.network;
  std::vector<PointComparison> predicted;
  for (const ControlObservation& control : network.control) {
    if (!solution.columns.point[control.point]) continue;
    const int column = *solution.columns.point[control.point];
    const Eigen::Vector3d weight = control.sigma.cwiseInverse();
    const Eigen::Matrix3d cofactor = solution.cofactor.Block(column, 3, column, 3);
    const Eigen::Matrix3d share =
        Eigen::Matrix3d::Identity() -
        Eigen::Matrix3d(weight.asDiagonal() * cofactor * weight.asDiagonal());
    if (EigenOfSymmetric(share).values[0] < kControlled) continue;
    const NetworkPoint& point = network.points[control.point];
    const Eigen::Vector3d residual = (point.position - control.position).cwiseProduct(weight);
    const Eigen::Matrix3d inverse = share.inverse();
    PointComparison comparison;
    comparison.name = point.name;
    comparison.difference = (inverse * residual).cwiseProduct(control.sigma);
    // What is predicted has the network's sigma0 and its lens in it, as a check point's sigma has.
    const Eigen::Vector3d of_network = VarianceFactor(solution.sigma0, solution.redundancy) *
                                       (inverse.diagonal().array() - 1).max(0).matrix();
    const Eigen::Matrix3d by_lens = inverse * weight.asDiagonal() *
                                    LensCovariance(network, solution, column) *
                                    weight.asDiagonal() * inverse.transpose();
    comparison.adjusted_sigma =
        (of_network + by_lens.diagonal()).cwiseSqrt().cwiseProduct(control.sigma);
    comparison.sigma =
        (comparison.adjusted_sigma.cwiseAbs2() + control.sigma.cwiseAbs2()).cwiseSqrt();
    comparison.surveyed = control.position + network.origin;
    comparison.surveyed_sigma = control.sigma;
    predicted.push_back(comparison);
  }
  return predicted;
}

}  // namespace insitu
