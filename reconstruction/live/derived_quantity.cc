// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/derived_quantity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "reconstruction/network/unit_tangents.h"

namespace insitu {
namespace {

constexpr double kLeastSide = 1e-9;  // [m]

// A function of the unknowns, put together from its derivatives.
class Derivative {
 public:
  explicit Derivative(const SolvedSurvey& solved)
      : solved_(solved), by_unknowns_(Eigen::MatrixXd::Zero(1, solved.solution.columns.count)) {}

  void Add(int point, const Eigen::Vector3d& gradient) {
    const auto column = solved_.solution.columns.point[point];
    if (column) by_unknowns_.middleCols<3>(*column) += gradient.transpose();
  }

  void AddDirection(int direction, const Eigen::Vector3d& gradient) {
    const auto column = solved_.solution.columns.direction[direction];
    if (!column) return;
    const Eigen::Vector3d& unit = solved_.survey_network.network.directions[direction].unit;
    by_unknowns_.middleCols<2>(*column) += gradient.transpose() * TangentsOf(unit);
  }

  double Sigma() const {
    const Eigen::MatrixXd variance =
        CovarianceOf(solved_.survey_network.network, solved_.solution, by_unknowns_);
    return std::sqrt(std::max(0.0, variance(0, 0)));
  }

 private:
  const SolvedSurvey& solved_;
  Eigen::MatrixXd by_unknowns_;
};

std::optional<int> PointIndex(const SolvedSurvey& solved, const std::string& name) {
  const auto index = solved.survey_network.index_of_point.find(name);
  if (index == solved.survey_network.index_of_point.end()) return std::nullopt;
  return index->second;
}

}  // namespace

std::optional<DerivedQuantity> AdjustedDistance(const SolvedSurvey& solved, const std::string& from,
                                                const std::string& to) {
  const auto a = PointIndex(solved, from), b = PointIndex(solved, to);
  if (!a || !b) return std::nullopt;
  const auto& points = solved.survey_network.network.points;
  const Eigen::Vector3d step = points[*b].position - points[*a].position;
  if (step.norm() < kLeastSide) return std::nullopt;
  Derivative derivative(solved);
  derivative.Add(*a, -step.normalized());
  derivative.Add(*b, step.normalized());
  return DerivedQuantity{step.norm(), derivative.Sigma()};
}

std::optional<DerivedQuantity> AdjustedHeight(const SolvedSurvey& solved, const std::string& from,
                                              const std::string& to) {
  const auto a = PointIndex(solved, from), b = PointIndex(solved, to);
  if (!a || !b) return std::nullopt;
  const Network& network = solved.survey_network.network;
  const int zenith = solved.survey_network.zenith.value();
  const Eigen::Vector3d step = network.points[*b].position - network.points[*a].position;
  const Eigen::Vector3d up = network.directions[zenith].unit;
  Derivative derivative(solved);
  derivative.Add(*a, -up);
  derivative.Add(*b, up);
  derivative.AddDirection(zenith, step);
  return DerivedQuantity{step.dot(up), derivative.Sigma()};
}

std::optional<DerivedQuantity> AdjustedAngle(const SolvedSurvey& solved, const std::string& first,
                                             const std::string& apex, const std::string& second) {
  const auto a = PointIndex(solved, first), o = PointIndex(solved, apex),
             b = PointIndex(solved, second);
  if (!a || !o || !b) return std::nullopt;
  const auto& points = solved.survey_network.network.points;
  const Eigen::Vector3d to_a = points[*a].position - points[*o].position;
  const Eigen::Vector3d to_b = points[*b].position - points[*o].position;
  if (to_a.norm() < kLeastSide || to_b.norm() < kLeastSide) return std::nullopt;
  const Eigen::Vector3d u = to_a.normalized(), v = to_b.normalized();
  Eigen::Vector3d axis = u.cross(v);
  const double angle = std::atan2(axis.norm(), u.dot(v));
  axis = axis.norm() > 1e-12 ? Eigen::Vector3d(axis.normalized()) : u.unitOrthogonal();
  // Turning a side about the axis by w moves its end by w times its length, across it.
  const Eigen::Vector3d by_a = -axis.cross(u) / to_a.norm(), by_b = axis.cross(v) / to_b.norm();
  Derivative derivative(solved);
  derivative.Add(*a, by_a);
  derivative.Add(*b, by_b);
  derivative.Add(*o, -by_a - by_b);
  return DerivedQuantity{angle, derivative.Sigma()};
}

}  // namespace insitu
