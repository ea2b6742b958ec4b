// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_predictions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/json_file.h"
#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/projection_uncertainty.h"
#include "reconstruction/live/one_ray.h"
#include "renderer/live/live_polygons.h"

namespace insitu {
namespace {

Json::Value EllipseOf(const ImageUncertainty& image) {
  const Eigen::Vector2d major = EigenOfSymmetric(image.covariance_px).vectors.col(1);
  Json::Value ellipse;
  ellipse["x"] = image.pixel.x();
  ellipse["y"] = image.pixel.y();
  ellipse["major"] = kEllipse95 * image.major_px;
  ellipse["minor"] = kEllipse95 * image.minor_px;
  ellipse["angle"] = std::atan2(major.y(), major.x());
  return ellipse;
}

// How one photo is known together with every unknown of the network.
class PhotoCovariance {
 public:
  PhotoCovariance(const SolvedSurvey& solved, size_t photo, const Eigen::MatrixXd& own)
      : network_(solved.survey_network.network), solution_(solved.solution), own_(own) {
    const int rotation = *solution_.columns.rotation[photo];
    pose_size_ = solution_.columns.center[photo] ? 6 : 3;
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(solution_.columns.count, pose_size_);
    units.middleRows(rotation, pose_size_).setIdentity();
    with_pose_ = solution_.sigma0 * solution_.sigma0 * solution_.cofactor.Times(units);
    for (size_t i = 0; i < network_.cameras.size(); ++i) {
      const Eigen::MatrixXd& by_lens = solution_.lens_sensitivity[i];
      if (by_lens.size() == 0) continue;
      with_pose_ += by_lens * network_.cameras[i].calibration_covariance *
                    by_lens.middleRows(rotation, pose_size_).transpose();
    }
    camera_ = network_.photos[photo].camera;
  }

  // 3 x n against the camera's covariance, of the point whose unknowns start at a column.
  Eigen::MatrixXd WithPoint(int column) const {
    Eigen::MatrixXd with = Eigen::MatrixXd::Zero(3, own_.cols());
    with.leftCols(pose_size_) = with_pose_.middleRows<3>(column);
    const Eigen::MatrixXd& by_lens = solution_.lens_sensitivity[camera_];
    if (by_lens.size() > 0) {
      with.rightCols(own_.cols() - 6) =
          by_lens.middleRows<3>(column) * network_.cameras[camera_].calibration_covariance;
    }
    return with;
  }

  const Eigen::MatrixXd& own() const { return own_; }

 private:
  const Network& network_;
  const NetworkSolution& solution_;
  const Eigen::MatrixXd& own_;
  int pose_size_ = 6, camera_ = 0;
  Eigen::MatrixXd with_pose_;
};

class Predictor {
 public:
  Predictor(const SolvedSurvey& solved, const std::vector<PosedCamera>& cameras)
      : cameras_(cameras), own_(CameraCovariances(solved.survey_network.network, solved.solution)) {
    for (size_t i = 0; i < cameras.size(); ++i) {
      views_.emplace_back(cameras[i].camera);
      covariances_.emplace_back(solved, i, own_[i]);
    }
  }

  Json::Value Adjusted(const AdjustedPoint& point, std::optional<int> column) const {
    return Point(point.position, point.covariance, point.rays, column);
  }

  static Json::Value OnPlane(const PointOnPlane& point, const std::string& polygon) {
    Json::Value told = About(point.position, point.covariance, 1);
    told["plane"] = polygon;
    for (const auto& [photo, image] : point.images) told["images"][photo] = EllipseOf(image);
    return told;
  }

  Json::Value Surveyed(const ControlPoint& point) const {
    return Point(point.position, point.sigma.cwiseAbs2().asDiagonal(), 0, std::nullopt);
  }

 private:
  static Json::Value About(const Eigen::Vector3d& position, const Eigen::Matrix3d& covariance,
                           int rays) {
    Json::Value point;
    point["xyz"] = ToJson(position);
    point["sigma"] = ToJson(Eigen::Vector3d(covariance.diagonal().cwiseSqrt()));
    point["rays"] = rays;
    point["images"] = Json::objectValue;
    return point;
  }

  Json::Value Point(const Eigen::Vector3d& position, const Eigen::Matrix3d& covariance, int rays,
                    std::optional<int> column) const {
    Json::Value point = About(position, covariance, rays);
    for (size_t i = 0; i < cameras_.size(); ++i) {
      if (!views_[i].PixelOf(cameras_[i].cam_from_world * position)) continue;
      PointUncertainty uncertain{covariance, {}};
      if (column) uncertain.with_camera = covariances_[i].WithPoint(*column);
      const auto image =
          ProjectWithUncertainty(cameras_[i], covariances_[i].own(), position, uncertain);
      if (image) point["images"][cameras_[i].photo] = EllipseOf(*image);
    }
    return point;
  }

  const std::vector<PosedCamera>& cameras_;
  std::vector<Eigen::MatrixXd> own_;
  std::vector<LensView> views_;
  std::vector<PhotoCovariance> covariances_;
};

// The marks on `cameras` that are a point's only one there, but of the points that are known.
std::vector<const ImageObservation*> SingleMarks(const Survey& survey, const Json::Value& known,
                                                 const std::vector<PosedCamera>& cameras) {
  std::map<std::string, std::vector<const ImageObservation*>> marks;
  for (const ImageObservation& mark : survey.observations) {
    const bool is_posed = std::any_of(cameras.begin(), cameras.end(), [&](const auto& camera) {
      return camera.photo == mark.photo && camera.camera.Sees(mark.pixel);
    });
    if (is_posed && !known.isMember(mark.point)) marks[mark.point].push_back(&mark);
  }
  std::vector<const ImageObservation*> single;
  for (const auto& [point, own] : marks) {
    if (own.size() == 1) single.push_back(own[0]);
  }
  return single;
}

}  // namespace

void AddPointsOnPlanes(const Survey& survey, const Survey& part, const SolvedSurvey& solved,
                       const std::vector<PosedCamera>& cameras, double plane_sigma,
                       Json::Value* points) {
  const std::vector<Polygon> polygons = AdjustedPolygons(part, solved.survey_network);
  for (const ImageObservation* mark : SingleMarks(survey, *points, cameras)) {
    const auto camera = std::find_if(cameras.begin(), cameras.end(),
                                     [&](const auto& each) { return each.photo == mark->photo; });
    const auto seen = PolygonSeenAt(polygons, *camera, mark->pixel);
    if (!seen) continue;
    const auto point = WhereRayMeets(solved, {mark->photo, mark->pixel, mark->sigma_px},
                                     part.polygons[*seen], plane_sigma);
    if (point) (*points)[mark->point] = Predictor::OnPlane(*point, polygons[*seen].name);
  }
}

Json::Value PredictedPoints(const Survey& survey, const SolvedSurvey& solved,
                            const std::vector<PosedCamera>& cameras) {
  const Predictor predictor(solved, cameras);
  const Network& network = solved.survey_network.network;
  Json::Value points = Json::objectValue;
  const std::vector<AdjustedPoint> adjusted = AdjustedPoints(network, solved.solution);
  for (size_t i = 0; i < adjusted.size(); ++i) {
    if (adjusted[i].is_tie_point) continue;
    points[adjusted[i].name] = predictor.Adjusted(adjusted[i], solved.solution.columns.point[i]);
  }
  for (const ControlPoint& point : survey.control_points) {
    if (!points.isMember(point.name)) points[point.name] = predictor.Surveyed(point);
  }
  return points;
}

}  // namespace insitu
