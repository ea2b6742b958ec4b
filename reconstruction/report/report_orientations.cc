// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_orientations.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/json_file.h"
#include "calibration/lens/camera.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/report/report_lens_residuals.h"

namespace insitu {
namespace {

constexpr int kCellsOfTiePoints = 24;  // per longer side of a photo

Json::Value Parameters(const AdjustedCamera& camera) {
  Json::Value json(Json::arrayValue);
  for (const AdjustedCamera::Parameter& parameter : camera.parameters) {
    Json::Value row;
    row["name"] = parameter.name;
    row["value"] = parameter.value;
    row["is_adjusted"] = parameter.is_adjusted;
    row["sigma"] = parameter.sigma > 0 ? Json::Value(parameter.sigma) : Json::Value();
    row["t"] = parameter.is_adjusted && parameter.sigma > 0
                   ? Json::Value(std::abs(parameter.value) / parameter.sigma)
                   : Json::Value();
    row["p"] = parameter.significance ? Json::Value(*parameter.significance) : Json::Value();
    json.append(row);
  }
  return json;
}

// What the boards told of the lens; null members where a calibration did not say.
Json::Value CalibrationFacts(const Json::Value& calibration) {
  if (!calibration.isObject()) return Json::Value();
  Json::Value json;
  for (const char* key : {"source", "width", "height", "lens_model", "boards_found", "points",
                          "outliers", "rms_px", "worst_px", "uncertainty", "splined_uncertainty"}) {
    json[key] = calibration.get(key, Json::Value());
  }
  json["verdict"] = calibration["verdict"].get("status", Json::Value());
  return json;
}

// The outline within which the boards calibrated a camera [px]; null: not known.
Json::Value Region(const CameraContext& context) {
  if (context.calibrated_region.empty()) return Json::Value();
  Json::Value json(Json::arrayValue);
  for (const Eigen::Vector2d& corner : context.calibrated_region) {
    json.append(ToJson(Eigen::VectorXd(corner)));
  }
  return json;
}

// Viewing direction: azimuth clockwise from +y, elevation above the xy plane; roll clockwise of
// the picture about it.
Json::Value AnglesDeg(const Eigen::Matrix3d& axes) {  // rows: the camera's axes
  const Eigen::Vector3d right = axes.row(0), down = axes.row(1), forward = axes.row(2);
  Json::Value json;
  json["azimuth"] = std::atan2(forward.x(), forward.y()) / kDegree;
  json["elevation"] = std::asin(std::clamp(forward.z(), -1.0, 1.0)) / kDegree;
  json["roll"] = std::atan2(right.z(), -down.z()) / kDegree;
  return json;
}

// Shares of the frame that the marks reach: their bounding rectangle's area, their hull's, and the
// largest radius over half the diagonal.
Json::Value Coverage(const AdjustedPose& pose, const Camera& camera,
                     const std::vector<ImageMark>& marks) {
  Json::Value json;
  const Eigen::Vector2d size(camera.width(), camera.height());
  const Eigen::Vector2d middle = (size.array() - 1) / 2;
  Eigen::Array2d low = size, high = Eigen::Array2d::Zero();
  double radius = 0;
  for (const ImageMark& mark : marks) {
    low = low.min(mark.pixel.array());
    high = high.max(mark.pixel.array());
    radius = std::max(radius, (mark.pixel - middle).norm());
  }
  json["rectangle"] = marks.empty() ? 0 : ((high - low) / size.array()).prod();
  json["hull"] = pose.coverage;
  json["radial"] = radius / (size.norm() / 2);
  return json;
}

// In their order; if there are more than `limit`, those of the largest |w|, largest first.
Json::Value MarksReport(const std::vector<ImageMark>& marks, size_t limit) {
  std::vector<const ImageMark*> listed;
  for (const ImageMark& mark : marks) {
    if (!mark.is_tie_point) listed.push_back(&mark);
  }
  if (listed.size() > limit) {
    std::stable_sort(listed.begin(), listed.end(), [](const ImageMark* a, const ImageMark* b) {
      return a->w.value_or(0) > b->w.value_or(0);
    });
    listed.resize(limit);
  }
  Json::Value json(Json::arrayValue);
  for (const ImageMark* mark : listed) {
    Json::Value row;
    row["point"] = mark->point;
    row["x"] = mark->pixel.x();
    row["y"] = mark->pixel.y();
    row["vx"] = mark->residual.x();
    row["vy"] = mark->residual.y();
    row["w"] = mark->w ? Json::Value(*mark->w) : Json::Value();
    json.append(row);
  }
  return json;
}

Json::Value OutsideRegion(const std::vector<ImageMark>& marks, const CameraContext& context) {
  Json::Value names(Json::arrayValue);
  for (const ImageMark& mark : marks) {
    if (!mark.is_tie_point && !IsCalibratedAt(context, mark.pixel)) names.append(mark.point);
  }
  return names;
}

Json::Value ExteriorOrientation(const AdjustedPose& pose) {
  const Eigen::VectorXd sigma = pose.covariance.diagonal().cwiseSqrt();
  const Eigen::Matrix3d rotation = pose.cam_from_world.rotation.toRotationMatrix();
  Json::Value json;
  json["center"] = ToJson(Eigen::VectorXd(Center(pose.cam_from_world)));
  json["center_sigma_m"] = ToJson(Eigen::VectorXd(sigma.tail<3>()));
  json["angles_deg"] = AnglesDeg(rotation);
  json["rotation_sigma_deg"] = ToJson(Eigen::VectorXd(sigma.head<3>() / kDegree));
  json["cam_from_world_rotation"] = ToJson(Eigen::MatrixXd(rotation));
  json["covariance"] = ToJson(Eigen::MatrixXd(pose.covariance));
  json["lens_correlation"] =
      pose.lens_correlation.size() > 0 ? ToJson(pose.lens_correlation) : Json::Value();
  return json;
}

Json::Value PhotoReport(const AdjustedPose& pose, const Camera& camera,
                        const std::vector<ImageMark>& marks, const ReportExtent& extent) {
  Eigen::Array2d squares = Eigen::Array2d::Zero(), largest = Eigen::Array2d::Zero();
  std::vector<ImageMark> tie_points;
  for (const ImageMark& mark : marks) {
    squares += mark.residual.array().square();
    largest = largest.max(mark.residual.array().abs());
    if (mark.is_tie_point) tie_points.push_back(mark);
  }
  const double count = std::max(1.0, static_cast<double>(marks.size()));
  Json::Value photo = ExteriorOrientation(pose);
  photo["photo"] = pose.photo;
  photo["camera"] = pose.camera;
  photo["width"] = camera.width();
  photo["height"] = camera.height();
  photo["points"] = static_cast<Json::UInt64>(marks.size());
  photo["rms_px"] = std::sqrt(squares.sum() / count);
  photo["rms_xy_px"] = ToJson(Eigen::VectorXd((squares / count).sqrt()));
  photo["max_xy_px"] = ToJson(Eigen::VectorXd(largest));
  photo["coverage"] = Coverage(pose, camera, marks);
  photo["marks"] = MarksReport(marks, extent.MarksOf(pose.photo));
  photo["tie_point_marks"] = static_cast<Json::UInt64>(tie_points.size());
  photo["tie_point_grid"] =
      extent.photos_in_full.contains(pose.photo)
          ? ResidualGrid(tie_points, camera.width(), camera.height(), kCellsOfTiePoints)
          : Json::Value(Json::arrayValue);
  return photo;
}

}  // namespace

Json::Value CamerasSection(const Adjustment& adjustment, const ReportContext& context) {
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < adjustment.cameras.size(); ++i) {
    const AdjustedCamera& adjusted = adjustment.cameras[i];
    Json::Value camera;
    camera["name"] = adjusted.name;
    camera["lens_model"] = adjusted.lens_model;
    camera["parameters"] = Parameters(adjusted);
    camera["correlation"] =
        adjusted.correlation.size() > 0 ? ToJson(adjusted.correlation) : Json::Value();
    camera["is_considered"] = adjusted.is_considered;
    const CameraContext& known = ContextOf(context.cameras, static_cast<int>(i));
    camera["model_file"] = known.model_file.empty() ? Json::Value() : Json::Value(known.model_file);
    camera["calibration"] = CalibrationFacts(known.calibration);
    camera["calibrated_region"] = Region(known);
    json.append(camera);
  }
  return json;
}

Json::Value PhotosSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                          const ReportContext& context, const ReportExtent& extent) {
  std::vector<std::vector<ImageMark>> marks_of_photo(adjustment.poses.size());
  for (const ImageMark& mark : marks) marks_of_photo[mark.photo].push_back(mark);
  Json::Value json(Json::arrayValue);
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    const AdjustedPose& pose = adjustment.poses[i];
    Json::Value photo =
        PhotoReport(pose, adjustment.scene.cameras[i].camera, marks_of_photo[i], extent);
    const auto thumbnail = context.thumbnails.find(pose.photo);
    if (thumbnail != context.thumbnails.end()) photo["thumbnail"] = thumbnail->second;
    photo["outside_calibrated_region"] =
        OutsideRegion(marks_of_photo[i], ContextOf(context.cameras, pose.camera));
    json.append(photo);
  }
  return json;
}

}  // namespace insitu
