// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_points.h"

#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/json_file.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr size_t kTiePointsShown = 2000;

double AzimuthDeg(const Eigen::Vector3d& axis) { return std::atan2(axis.x(), axis.y()) / kDegree; }

// Semi-axes of the standard ellipsoid, longest first, and where the longest points: upwards, or
// for the ellipse in plan to the east half.
Json::Value Ellipsoid(const Eigen::Matrix3d& covariance) {
  const SymmetricEigen<3> space = EigenOfSymmetric(covariance);
  const SymmetricEigen<2> plan = EigenOfSymmetric<2>(covariance.topLeftCorner<2, 2>());
  Eigen::Vector3d longest = space.vectors.col(2);
  if (longest.z() < 0) longest = -longest;
  Eigen::Vector3d in_plan(plan.vectors(0, 1), plan.vectors(1, 1), 0);
  if (in_plan.x() < 0) in_plan = -in_plan;
  const Eigen::VectorXd semi_axes = space.values.reverse().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd plan_axes = plan.values.reverse().cwiseMax(0).cwiseSqrt();
  Json::Value json;
  json["semi_axes_m"] = ToJson(semi_axes);
  json["azimuth_deg"] = AzimuthDeg(longest);
  json["elevation_deg"] = std::asin(std::clamp(longest.z(), -1.0, 1.0)) / kDegree;
  json["plan_semi_axes_m"] = ToJson(plan_axes);
  json["plan_azimuth_deg"] = AzimuthDeg(in_plan);
  return json;
}

// Median, 95th percentile and maximum.
Json::Value Spread(std::vector<double> values) {
  if (values.empty()) return Json::Value();
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
  };
  Json::Value json;
  json["median"] = at(0.5);
  json["percentile_95"] = at(0.95);
  json["max"] = values.back();
  return json;
}

Json::Value Comparison(const PointComparison& point) {
  const Eigen::VectorXd adjusted = point.surveyed + point.difference;
  const Eigen::VectorXd ratio = point.adjusted_sigma.cwiseQuotient(point.surveyed_sigma);
  Json::Value json;
  json["name"] = point.name;
  json["surveyed"] = ToJson(Eigen::VectorXd(point.surveyed));
  json["surveyed_sigma_m"] = ToJson(Eigen::VectorXd(point.surveyed_sigma));
  json["adjusted"] = ToJson(adjusted);
  json["adjusted_sigma_m"] = ToJson(Eigen::VectorXd(point.adjusted_sigma));
  json["sigma_ratio"] = ToJson(ratio);  // adjusted over surveyed
  json["difference_m"] = ToJson(Eigen::VectorXd(point.difference));
  json["sigma_m"] = ToJson(Eigen::VectorXd(point.sigma));  // that the difference is judged by
  json["plan_m"] = point.difference.head<2>().norm();
  json["space_m"] = point.difference.norm();
  json["over_sigma"] = point.difference.cwiseQuotient(point.sigma).cwiseAbs().maxCoeff();
  return json;
}

std::vector<const AdjustedPoint*> ListedPoints(const Adjustment& adjustment, size_t limit) {
  std::vector<const AdjustedPoint*> listed;
  for (const AdjustedPoint& point : adjustment.points) {
    if (!point.is_tie_point) listed.push_back(&point);
  }
  if (listed.size() <= limit) return listed;
  std::stable_sort(listed.begin(), listed.end(),
                   [](const AdjustedPoint* a, const AdjustedPoint* b) {
                     return a->covariance.trace() > b->covariance.trace();
                   });
  listed.resize(limit);
  return listed;
}

}  // namespace

Json::Value PointsSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                          size_t limit) {
  const std::map<std::string, double> angles = LargestRayAngles(adjustment, marks);
  Json::Value json(Json::arrayValue);
  for (const AdjustedPoint* listed : ListedPoints(adjustment, limit)) {
    const AdjustedPoint& adjusted = *listed;
    const auto angle = angles.find(adjusted.name);
    const Eigen::VectorXd sigma = adjusted.covariance.diagonal().cwiseSqrt();
    Json::Value point;
    point["name"] = adjusted.name;
    point["position"] = ToJson(Eigen::VectorXd(adjusted.position));
    point["sigma_m"] = ToJson(sigma);
    point["covariance_m2"] = ToJson(Eigen::MatrixXd(adjusted.covariance));
    point["ellipsoid"] = Ellipsoid(adjusted.covariance);
    point["rays"] = adjusted.rays;
    point["rms_px"] = adjusted.rays > 0 ? Json::Value(adjusted.rms_px) : Json::Value();
    point["largest_angle_deg"] =
        angle != angles.end() ? Json::Value(angle->second / kDegree) : Json::Value();
    json.append(point);
  }
  return json;
}

Json::Value TiePointsSection(const Adjustment& adjustment) {
  std::vector<const AdjustedPoint*> points;
  for (const AdjustedPoint& point : adjustment.points) {
    if (point.is_tie_point) points.push_back(&point);
  }
  std::vector<double> sigmas, residuals;
  std::map<int, int> points_of_rays;
  for (const AdjustedPoint* point : points) {
    sigmas.push_back(std::sqrt(point->covariance.trace()));
    residuals.push_back(point->rms_px);
    ++points_of_rays[point->rays];
  }
  Json::Value json;
  json["count"] = static_cast<Json::UInt64>(points.size());
  json["sigma_m"] = Spread(sigmas);  // in space, sqrt(trace)
  json["rms_px"] = Spread(residuals);
  json["rays"] = Json::Value(Json::arrayValue);
  for (const auto& [rays, count] : points_of_rays) {
    Json::Value row;
    row["rays"] = rays;
    row["count"] = count;
    json["rays"].append(row);
  }
  json["shown"] = Json::Value(Json::arrayValue);  // evenly picked, for the plots
  const size_t step = std::max<size_t>(1, (points.size() + kTiePointsShown - 1) / kTiePointsShown);
  for (size_t i = 0; i < points.size(); i += step) {
    json["shown"].append(ToJson(Eigen::VectorXd(points[i]->position)));
  }
  return json;
}

Json::Value ComparisonSection(const std::vector<PointComparison>& comparisons) {
  Json::Value json;
  json["points"] = Json::Value(Json::arrayValue);
  for (const PointComparison& point : comparisons) json["points"].append(Comparison(point));
  if (comparisons.empty()) return json;
  const auto count = static_cast<double>(comparisons.size());
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = sum, largest = sum;
  double over_sigma = 0, plan = 0, space = 0;
  for (const PointComparison& point : comparisons) {
    const Eigen::Array3d difference = point.difference.array();
    sum += difference;
    squares += difference.square();
    largest = largest.max(difference.abs());
    over_sigma += (difference / point.sigma.array()).square().sum();
    plan = std::max(plan, point.difference.head<2>().norm());
    space = std::max(space, point.difference.norm());
  }
  json["mean_m"] = ToJson(Eigen::VectorXd(sum / count));
  json["rms_m"] = ToJson(Eigen::VectorXd((squares / count).sqrt()));
  json["rms_plan_m"] = std::sqrt(squares.head<2>().sum() / count);
  json["rms_space_m"] = std::sqrt(squares.sum() / count);
  json["max_m"] = ToJson(Eigen::VectorXd(largest));
  json["max_plan_m"] = plan;
  json["max_space_m"] = space;
  json["rms_over_sigma"] = std::sqrt(over_sigma / (3 * count));
  return json;
}

}  // namespace insitu
