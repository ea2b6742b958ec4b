// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/control_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace insitu {
namespace {

constexpr double kFirstTolerance = 12;  // [px], while the pose rests on four marks only
constexpr double kTolerance = 6;        // [sigma]
constexpr double kLeastTolerance = 2;   // [px], marks are seldom as good as their sigma
constexpr int kSamples = 2000;

// Infinite behind the camera: no tolerance is wide enough.
double ResidualPx(const ControlMark& mark, const Camera& camera, const Rigid3& cam_from_world) {
  const auto pixel = camera.Project(cam_from_world * mark.control->position);
  return pixel ? (*pixel - mark.mark->pixel).norm() : std::numeric_limits<double>::infinity();
}

std::optional<ControlFit> FitMarks(const std::vector<ControlMark>& marks, const Camera& camera,
                                   size_t photo, const std::optional<Rigid3>& initial) {
  if (marks.size() < 4) return std::nullopt;
  std::vector<ResectionPoint> points;
  for (const ControlMark& mark : marks) {
    points.push_back({mark.control->position, mark.mark->pixel, mark.mark->sigma_px});
  }
  const auto resection = Resect(camera, points, initial);
  if (!resection) return std::nullopt;
  double squares = 0;
  for (const ControlMark& mark : marks) {
    const double sigma = SigmaPx(mark, camera, resection->cam_from_world);
    squares += std::pow(ResidualPx(mark, camera, resection->cam_from_world) / sigma, 2);
  }
  const auto redundancy = static_cast<double>(2 * marks.size() - 6);
  return ControlFit{photo,
                    marks,
                    resection->cam_from_world,
                    resection->covariance.bottomRightCorner<3, 3>(),
                    resection->rms_px,
                    std::sqrt(squares / redundancy)};
}

// OpenCV's consensus of samples of four, about a local origin; it seeds itself alike each time.
std::optional<Rigid3> ConsensusPose(const std::vector<ControlMark>& marks, const Camera& camera) {
  const Eigen::Vector3d origin = marks[0].control->position;
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> tangents;
  for (const ControlMark& mark : marks) {
    const Eigen::Vector3d sight = camera.Unproject(mark.mark->pixel);
    if (!(sight.z() > 0.1 * sight.norm())) return std::nullopt;
    const Eigen::Vector3d local = mark.control->position - origin;
    objects.emplace_back(local.x(), local.y(), local.z());
    tangents.emplace_back(sight.x() / sight.z(), sight.y() / sight.z());
  }
  cv::Mat vector, translation;
  try {
    const double tolerance = kFirstTolerance / camera.focal_px();
    if (!cv::solvePnPRansac(objects, tangents, cv::Matx33d::eye(), cv::noArray(), vector,
                            translation, false, kSamples, static_cast<float>(tolerance), 0.9999,
                            cv::noArray(), cv::SOLVEPNP_P3P)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {
    return std::nullopt;  // OpenCV's word for marks that coincide
  }
  cv::Mat matrix;
  cv::Rodrigues(vector, matrix);
  Eigen::Matrix3d rotation;
  Rigid3 cam_from_local;
  cv::cv2eigen(matrix, rotation);
  cv::cv2eigen(translation, cam_from_local.translation);
  if (!rotation.allFinite() || !cam_from_local.translation.allFinite()) return std::nullopt;
  cam_from_local.rotation = Eigen::Quaterniond(rotation).normalized();
  return cam_from_local * Rigid3{Eigen::Quaterniond::Identity(), -origin};
}

std::vector<ControlMark> Agreeing(const std::vector<ControlMark>& marks, const Camera& camera,
                                  const Rigid3& cam_from_world, double least_tolerance) {
  std::vector<ControlMark> agreeing;
  for (const ControlMark& mark : marks) {
    const double sigma = SigmaPx(mark, camera, cam_from_world);
    const double tolerance = std::max(least_tolerance, kTolerance * sigma);
    if (ResidualPx(mark, camera, cam_from_world) < tolerance) agreeing.push_back(mark);
  }
  return agreeing;
}

}  // namespace

std::vector<ControlMark> ControlMarksOn(const Survey& survey, const std::string& photo) {
  std::map<std::string, const ControlPoint*> control;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kControl) control[point.name] = &point;
  }
  std::vector<ControlMark> marks;
  for (const ImageObservation& mark : survey.observations) {
    const auto point = control.find(mark.point);
    if (mark.photo == photo && point != control.end()) marks.push_back({&mark, point->second});
  }
  return marks;
}

double SigmaPx(const ControlMark& mark, const Camera& camera, const Rigid3& cam_from_world) {
  const double distance = (cam_from_world * mark.control->position).norm();
  const double sigma = mark.control->sigma.norm() / std::sqrt(3);
  return std::hypot(mark.mark->sigma_px, camera.focal_px() * sigma / distance);
}

std::optional<ControlFit> FitControl(const Survey& survey, const std::vector<std::string>& photos,
                                     const std::vector<Camera>& cameras, size_t photo) {
  return FitMarks(ControlMarksOn(survey, photos[photo]), cameras[photo], photo, std::nullopt);
}

std::optional<RobustFit> FitControlRobustly(const Survey& survey,
                                            const std::vector<std::string>& photos,
                                            const std::vector<Camera>& cameras, size_t photo) {
  const Camera& camera = cameras[photo];
  const std::vector<ControlMark> marks = ControlMarksOn(survey, photos[photo]);
  if (marks.size() < 5) return std::nullopt;
  const std::optional<Rigid3> consensus = ConsensusPose(marks, camera);
  if (!consensus) return std::nullopt;
  std::vector<ControlMark> agreeing = Agreeing(marks, camera, *consensus, kFirstTolerance);
  std::optional<ControlFit> fit = FitMarks(agreeing, camera, photo, consensus);
  for (int pass = 0; fit && pass < 3; ++pass) {
    agreeing = Agreeing(marks, camera, fit->cam_from_world, kLeastTolerance);
    fit = FitMarks(agreeing, camera, photo, fit->cam_from_world);
  }
  if (!fit || 5 * agreeing.size() < 3 * marks.size()) return std::nullopt;
  RobustFit robust{*fit, {}};
  for (const ControlMark& mark : marks) {
    const bool agrees = std::any_of(agreeing.begin(), agreeing.end(),
                                    [&](const auto& other) { return other.mark == mark.mark; });
    if (!agrees) robust.outliers.push_back(mark);
  }
  return robust;
}

}  // namespace insitu
