// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/residual_report.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "calibration/json_file.h"
#include "reconstruction/verdict.h"

namespace insitu {
namespace {

constexpr double kDegree = M_PI / 180;

Json::Value Vector(const Eigen::VectorXd& vector) { return ToJson(vector); }

Json::Value Summary(const Adjustment& adjustment) {
  Json::Value json;
  json["observations"] = adjustment.observations;
  json["unknowns"] = adjustment.unknowns;
  json["redundancy"] = adjustment.redundancy;
  json["sigma0"] = adjustment.sigma0;
  json["chi_square_p"] = adjustment.chi_square_p;
  json["iterations"] = adjustment.iterations;
  json["vertex_sigma_m"] = adjustment.scene.vertex_sigma;
  return json;
}

// Per group the count, the share of the redundancy, and sigma0 from its residuals alone.
Json::Value Groups(const Adjustment& adjustment) {
  struct Sums {
    int count = 0;
    double redundancy = 0, squares = 0;
  };
  std::map<std::string, Sums> groups;
  for (const ObservationResidual& row : adjustment.residuals) {
    Sums& sums = groups[row.group];
    sums.count += 1;
    sums.redundancy += row.redundancy;
    sums.squares += std::pow(row.residual / row.sigma, 2);
  }
  Json::Value json(Json::arrayValue);
  for (const auto& [name, sums] : groups) {
    Json::Value group;
    group["group"] = name;
    group["count"] = sums.count;
    group["redundancy"] = sums.redundancy;
    group["sigma0"] = sums.redundancy > 1e-6
                          ? Json::Value(std::sqrt(sums.squares / sums.redundancy))
                          : Json::Value();
    json.append(group);
  }
  return json;
}

// Viewing direction: azimuth clockwise from +y, elevation above the xy plane; roll clockwise of
// the picture about it.
Json::Value AnglesDeg(const Rigid3& cam_from_world) {
  const Eigen::Matrix3d axes = cam_from_world.rotation.toRotationMatrix();  // rows: camera's axes
  const Eigen::Vector3d right = axes.row(0), down = axes.row(1), forward = axes.row(2);
  Json::Value json;
  json["azimuth"] = std::atan2(forward.x(), forward.y()) / kDegree;
  json["elevation"] = std::asin(std::clamp(forward.z(), -1.0, 1.0)) / kDegree;
  json["roll"] = std::atan2(right.z(), -down.z()) / kDegree;
  return json;
}

Json::Value Photos(const Adjustment& adjustment) {
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    const AdjustedPose& pose = adjustment.poses[i];
    const Camera& camera = adjustment.scene.cameras[i].camera;
    const Eigen::VectorXd sigma = pose.covariance.diagonal().cwiseSqrt();
    Json::Value photo;
    photo["photo"] = pose.photo;
    photo["width"] = camera.width();
    photo["height"] = camera.height();
    photo["points"] = pose.points;
    photo["rms_px"] = pose.rms_px;
    photo["center"] = Vector(Center(pose.cam_from_world));
    photo["center_sigma_m"] = Vector(sigma.tail<3>());
    photo["angles_deg"] = AnglesDeg(pose.cam_from_world);
    photo["rotation_sigma_deg"] = Vector(sigma.head<3>() / kDegree);
    photo["cam_from_world_rotation"] =
        ToJson(Eigen::MatrixXd(pose.cam_from_world.rotation.toRotationMatrix()));
    photo["covariance"] = ToJson(Eigen::MatrixXd(pose.covariance));
    json.append(photo);
  }
  return json;
}

Json::Value Points(const Adjustment& adjustment, const Survey& survey) {
  const std::map<std::string, double> angles = LargestRayAngles(adjustment, survey);
  Json::Value json(Json::arrayValue);
  for (const AdjustedPoint& adjusted : adjustment.points) {
    const auto angle = angles.find(adjusted.name);
    Json::Value point;
    point["name"] = adjusted.name;
    point["position"] = Vector(adjusted.position);
    point["sigma_m"] = Vector(adjusted.covariance.diagonal().cwiseSqrt());
    point["rays"] = adjusted.rays;
    point["rms_px"] = adjusted.rays > 0 ? Json::Value(adjusted.rms_px) : Json::Value();
    point["largest_angle_deg"] =
        angle != angles.end() ? Json::Value(angle->second / kDegree) : Json::Value();
    json.append(point);
  }
  return json;
}

Json::Value Comparisons(const std::vector<PointComparison>& comparisons) {
  Json::Value json(Json::arrayValue);
  for (const PointComparison& comparison : comparisons) {
    Json::Value point;
    point["name"] = comparison.name;
    point["difference_m"] = Vector(comparison.difference);
    point["sigma_m"] = Vector(comparison.sigma);
    json.append(point);
  }
  return json;
}

Json::Value Check(const Adjustment& adjustment) {
  Json::Value json;
  json["points"] = Comparisons(adjustment.check);
  if (adjustment.check.empty()) return json;
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  for (const PointComparison& point : adjustment.check) {
    squares += point.difference.array().square();
  }
  json["rms_over_sigma"] = adjustment.check_rms_over_sigma;
  json["rms_m"] = Vector((squares / static_cast<double>(adjustment.check.size())).sqrt().matrix());
  return json;
}

Json::Value Polygons(const Adjustment& adjustment, const Survey& survey) {
  std::map<std::string, double> off_plane;  // by "polygon vertex"
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.group == "plane") off_plane[row.subject] = row.residual;
  }
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const PolygonOutline& outline = survey.polygons[i];
    Json::Value polygon;
    polygon["name"] = outline.name;
    polygon["material"] = outline.material;
    polygon["photo"] = outline.photo ? Json::Value(*outline.photo) : Json::Value();
    polygon["normal"] = Vector(adjustment.scene.polygons[i].normal);
    for (const std::string& name : outline.vertices) {
      const auto distance = off_plane.find(outline.name + " " + name);
      Json::Value vertex;
      vertex["name"] = name;
      vertex["off_plane_mm"] =
          distance == off_plane.end() ? Json::Value() : Json::Value(1000 * distance->second);
      polygon["vertices"].append(vertex);
    }
    json.append(polygon);
  }
  return json;
}

Json::Value DirectionReport(const Direction& direction, size_t pairs) {
  const double largest_variance =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(direction.covariance, Eigen::EigenvaluesOnly)
          .eigenvalues()[2];
  Json::Value json;
  json["unit"] = Vector(direction.unit);
  json["pairs"] = static_cast<Json::UInt64>(pairs);
  json["sigma_deg"] = std::sqrt(std::max(largest_variance, 0.0)) / kDegree;
  return json;
}

Json::Value Directions(const Adjustment& adjustment, const Survey& survey) {
  Json::Value json;
  const SceneGeometry& scene = adjustment.scene;
  json["sun"] = scene.sun ? DirectionReport(*scene.sun, survey.sun_pairs.size()) : Json::Value();
  json["zenith"] = DirectionReport(scene.zenith, survey.zenith_pairs.size());
  return json;
}

Json::Value Observations(const Adjustment& adjustment) {
  Json::Value json(Json::arrayValue);
  for (const ObservationResidual& row : adjustment.residuals) {
    Json::Value observation;
    observation["group"] = row.group;
    if (!row.photo.empty()) observation["photo"] = row.photo;
    observation["subject"] = row.subject;
    observation["observed"] = row.observed;
    observation["residual"] = row.residual;
    observation["sigma"] = row.sigma;
    observation["redundancy"] = row.redundancy;
    const std::optional<double> w = TestValue(row);
    observation["w"] = w ? Json::Value(*w) : Json::Value();
    json.append(observation);
  }
  return json;
}

}  // namespace

Json::Value ResidualReport(const Adjustment& adjustment, const Survey& survey) {
  Json::Value report;
  report["format"] = "insitu residual report 1";
  report["conventions"] =
      "metres and pixels unless a name says otherwise; residual = adjusted - observed; covariances "
      "scaled by sigma0^2, of a pose: left rotation increment [rad], then camera centre [m]";
  report["verdict"] = VerdictReport(Judge(adjustment, survey));
  report["summary"] = Summary(adjustment);
  report["groups"] = Groups(adjustment);
  report["photos"] = Photos(adjustment);
  report["points"] = Points(adjustment, survey);
  report["control"] = Comparisons(adjustment.control);
  report["check"] = Check(adjustment);
  report["polygons"] = Polygons(adjustment, survey);
  report["directions"] = Directions(adjustment, survey);
  report["observations"] = Observations(adjustment);
  return report;
}

}  // namespace insitu
