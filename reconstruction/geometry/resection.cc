// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/resection.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "calibration/lens/fit_camera.h"
#include "reconstruction/network/observation_costs.h"

namespace insitu {
namespace {

struct Candidate {
  Rigid3 cam_from_local;
  double rms_px = 0;
};

// The solvers see directions as (x/z, y/z), useless near 90 degrees off the axis.

std::vector<Rigid3> StartPoses(const Camera& camera, const std::vector<ResectionPoint>& points,
                               const Eigen::Vector3d& origin) {
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> tangents;
  for (const ResectionPoint& point : points) {
    const Eigen::Vector3d sight = camera.Unproject(point.pixel);
    if (sight.head<2>().norm() > kLargestTangent * sight.z()) continue;
    const Eigen::Vector3d local = point.world - origin;
    objects.emplace_back(local.x(), local.y(), local.z());
    tangents.emplace_back(sight.x() / sight.z(), sight.y() / sight.z());
  }
  std::vector<cv::Mat> rotations, translations;
  const cv::Matx33d identity = cv::Matx33d::eye();
  try {
    if (objects.size() == 3) {
      cv::solveP3P(objects, tangents, identity, cv::noArray(), rotations, translations,
                   cv::SOLVEPNP_P3P);
    } else if (objects.size() > 3) {
      cv::solvePnPGeneric(objects, tangents, identity, cv::noArray(), rotations, translations,
                          false, cv::SOLVEPNP_SQPNP);
    }
  } catch (const cv::Exception&) {
    return {};  // OpenCV's word for marks that coincide
  }
  std::vector<Rigid3> poses;
  for (size_t i = 0; i < rotations.size(); ++i) {
    cv::Mat matrix;
    cv::Rodrigues(rotations[i], matrix);
    Eigen::Matrix3d rotation;
    cv::cv2eigen(matrix, rotation);
    Rigid3 pose{Eigen::Quaterniond(rotation).normalized(), {}};
    cv::cv2eigen(translations[i], pose.translation);
    if (rotation.allFinite() && pose.translation.allFinite()) poses.push_back(pose);
  }
  return poses;
}

// Least squares over the pixel residuals; nullopt if a point ends behind the camera.
class Refinement {
 public:
  Refinement(const Camera& camera, const std::vector<ResectionPoint>& points,
             const Eigen::Vector3d& origin, const Rigid3& start)
      : lens_(camera), rotation_(start.rotation), center_(Center(start)) {
    for (const ResectionPoint& point : points) local_.push_back(point.world - origin);
    problem_.AddParameterBlock(rotation_.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
    problem_.AddParameterBlock(center_.data(), 3);
    for (size_t i = 0; i < points.size(); ++i) {
      problem_.AddResidualBlock(
          new MarkCost(lens_, &camera.intrinsics(), points[i].pixel, points[i].sigma_px), nullptr,
          rotation_.coeffs().data(), center_.data(), local_[i].data());
      problem_.SetParameterBlockConstant(local_[i].data());
    }
  }

  bool Solve() {
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 200;
    options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-15;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  Rigid3 CamFromLocal() const {
    const Eigen::Quaterniond rotation = rotation_.normalized();
    return {rotation, -(rotation * center_)};
  }

  Eigen::Matrix<double, 6, 6> Covariance() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = {rotation_.coeffs().data(), center_.data()};
    ceres::CRSMatrix sparse;
    problem_.Evaluate(options, nullptr, nullptr, nullptr, &sparse);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
    for (int row = 0; row < sparse.num_rows; ++row) {
      for (int k = sparse.rows[row]; k < sparse.rows[row + 1]; ++k) {
        jacobian(row, sparse.cols[k]) = sparse.values[k];
      }
    }
    jacobian.leftCols<3>() /= 2;  // Ceres' increment of a quaternion is half the angle
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    return normal.ldlt().solve(Eigen::MatrixXd::Identity(6, 6));
  }

 private:
  const Lens lens_;
  Eigen::Quaterniond rotation_;
  Eigen::Vector3d center_;
  std::vector<Eigen::Vector3d> local_;
  ceres::Problem problem_;
};

std::optional<double> RmsPx(const Camera& camera, const std::vector<ResectionPoint>& points,
                            const Eigen::Vector3d& origin, const Rigid3& cam_from_local) {
  double sum = 0;
  for (const ResectionPoint& point : points) {
    const auto pixel = camera.Project(cam_from_local * (point.world - origin));
    if (!pixel) return std::nullopt;
    sum += (*pixel - point.pixel).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

// Refined poses with every point before the camera, each once.
std::vector<Candidate> Refine(const Camera& camera, const std::vector<ResectionPoint>& points,
                              const Eigen::Vector3d& origin, const std::vector<Rigid3>& starts) {
  std::vector<Candidate> candidates;
  for (const Rigid3& start : starts) {
    if (!RmsPx(camera, points, origin, start)) continue;
    Refinement refinement(camera, points, origin, start);
    if (!refinement.Solve()) continue;
    const Rigid3 pose = refinement.CamFromLocal();
    const auto rms = RmsPx(camera, points, origin, pose);
    const bool is_new = std::none_of(candidates.begin(), candidates.end(), [&](const auto& other) {
      const double distance = (Center(other.cam_from_local) - Center(pose)).norm();
      return distance < 1e-6 * Center(pose).norm();
    });
    if (rms && is_new) candidates.push_back({pose, *rms});
  }
  return candidates;
}

// With three points every candidate fits: the one nearest to the estimate, or without one the most
// upright (photographers seldom stand on their heads). With more points, the best fit.
const Candidate& Choose(const std::vector<Candidate>& candidates, bool every_candidate_fits,
                        const std::optional<Rigid3>& initial_cam_from_local) {
  const auto cost = [&](const Candidate& candidate) {
    const Rigid3& pose = candidate.cam_from_local;
    if (!every_candidate_fits) return candidate.rms_px;
    if (initial_cam_from_local) return (Center(pose) - Center(*initial_cam_from_local)).norm();
    return (pose.rotation.conjugate() * Eigen::Vector3d::UnitY()).z();
  };
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
}

}  // namespace

bool AreCollinear(const std::vector<Eigen::Vector3d>& points, double tolerance) {
  if (points.size() < 3) return true;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += (point - points[0]) / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& point : points) {
    const Eigen::Vector3d offset = point - points[0] - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::Vector3d spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return !(spread[1] > tolerance * tolerance * spread[2]);
}

std::optional<ResectionResult> Resect(const Camera& camera,
                                      const std::vector<ResectionPoint>& points,
                                      const std::optional<Rigid3>& initial) {
  std::vector<Eigen::Vector3d> places;
  for (const ResectionPoint& point : points) places.push_back(point.world);
  if (AreCollinear(places)) return std::nullopt;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const auto& place : places)
    offset += (place - places[0]) / static_cast<double>(places.size());
  const Eigen::Vector3d origin = places[0] + offset;
  const Rigid3 world_from_local{Eigen::Quaterniond::Identity(), origin};

  std::vector<Rigid3> starts = StartPoses(camera, points, origin);
  std::optional<Rigid3> initial_cam_from_local;
  if (initial) {
    initial_cam_from_local = *initial * world_from_local;
    starts.push_back(*initial_cam_from_local);
  }
  const std::vector<Candidate> candidates = Refine(camera, points, origin, starts);
  if (candidates.empty()) return std::nullopt;
  const bool every_candidate_fits = points.size() == 3;
  const Candidate& best = Choose(candidates, every_candidate_fits, initial_cam_from_local);
  ResectionResult result;
  result.cam_from_world = best.cam_from_local * Inverse(world_from_local);
  result.rms_px = best.rms_px;
  result.covariance = Refinement(camera, points, origin, best.cam_from_local).Covariance();
  result.ambiguous = every_candidate_fits && candidates.size() > 1 && !initial;
  return result;
}

}  // namespace insitu
