// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/resection.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "calibration/algebra/decompositions.h"
#include "calibration/lens/fit_camera.h"
#include "reconstruction/network/observation_costs.h"

namespace insitu {
namespace {

struct Candidate {
  Rigid3 cam_from_local;
  double rms_px = 0;
};

constexpr double kReach =
    20;  // of the weighted square sum: odds of 1 to 20 000 against the worse pose
constexpr double kFlat =
    0.1;  // spread across a plane against that along it, up to which both its poses are tried
constexpr size_t kFewPoints = 10;  // up to which triples of points are asked for further poses
constexpr size_t kMostTriples = 8;
constexpr double kSamePose = 1e-3;  // of the distance, between two centres of one minimum
constexpr double kFarCenter = 5;    // [sigma], of a surveyed centre of projection
constexpr double kDecides =
    6;  // [px], between the images by two poses of what decides between them

// What OpenCV's solvers see: directions as (x/z, y/z), useless near 90 degrees off the axis.
struct PnpPoints {
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> tangents;
};

PnpPoints ForSolvers(const Camera& camera, const std::vector<ResectionPoint>& points,
                     const Eigen::Vector3d& origin) {
  PnpPoints seen;
  for (const ResectionPoint& point : points) {
    const Eigen::Vector3d sight = camera.Unproject(point.pixel);
    if (sight.head<2>().norm() > kLargestTangent * sight.z()) continue;
    const Eigen::Vector3d local = point.world - origin;
    seen.objects.emplace_back(local.x(), local.y(), local.z());
    seen.tangents.emplace_back(sight.x() / sight.z(), sight.y() / sight.z());
  }
  return seen;
}

std::vector<Rigid3> SolvedPoses(const PnpPoints& seen, int method) {
  std::vector<cv::Mat> rotations, translations;
  const cv::Matx33d identity = cv::Matx33d::eye();
  try {
    if (method == cv::SOLVEPNP_P3P) {
      cv::solveP3P(seen.objects, seen.tangents, identity, cv::noArray(), rotations, translations,
                   method);
    } else {
      cv::solvePnPGeneric(seen.objects, seen.tangents, identity, cv::noArray(), rotations,
                          translations, false, static_cast<cv::SolvePnPMethod>(method));
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

std::vector<Rigid3> StartPoses(const Camera& camera, const std::vector<ResectionPoint>& points,
                               const Eigen::Vector3d& origin) {
  const PnpPoints seen = ForSolvers(camera, points, origin);
  if (seen.objects.size() < 3) return {};
  return SolvedPoses(seen, seen.objects.size() == 3 ? cv::SOLVEPNP_P3P : cv::SOLVEPNP_SQPNP);
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
    return InverseOfSymmetric(normal);
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

std::vector<Eigen::Vector3d> PlacesOf(const std::vector<ResectionPoint>& points) {
  std::vector<Eigen::Vector3d> places;
  for (const ResectionPoint& point : points) places.push_back(point.world);
  return places;
}

// The points' centroid, near which nothing is lost.
Eigen::Vector3d OriginOf(const std::vector<ResectionPoint>& points) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const ResectionPoint& point : points) {
    offset += (point.world - points[0].world) / static_cast<double>(points.size());
  }
  return points[0].world + offset;
}

// The axes of the points' scatter, that across their plane first, and whether they are nearly flat.
struct Flatness {
  Eigen::Vector3d normal;
  double extent = 0;  // [m], rms along the plane's longer axis
  bool is_flat = false;
};

Flatness FlatnessOf(const std::vector<ResectionPoint>& points, const Eigen::Vector3d& origin) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const ResectionPoint& point : points) {
    const Eigen::Vector3d offset = point.world - origin;
    scatter += offset * offset.transpose() / static_cast<double>(points.size());
  }
  const SymmetricEigen<3> axes = EigenOfSymmetric(scatter);
  const Eigen::Vector3d spread = axes.values.cwiseMax(0).cwiseSqrt();
  return {axes.vectors.col(0), spread[2], spread[0] <= kFlat * spread[1]};
}

// Both poses of points that are flattened onto their plane.
void AddPlanePoses(PnpPoints seen, const Flatness& flatness, std::vector<Rigid3>* starts) {
  if (seen.objects.size() < 4) return;
  const cv::Point3d normal(flatness.normal.x(), flatness.normal.y(), flatness.normal.z());
  for (cv::Point3d& object : seen.objects) object -= normal * object.dot(normal);
  const std::vector<Rigid3> poses = SolvedPoses(seen, cv::SOLVEPNP_IPPE);
  starts->insert(starts->end(), poses.begin(), poses.end());
}

// Up to four poses of each of some triples, spread over the points.
void AddTriplePoses(const PnpPoints& seen, std::vector<Rigid3>* starts) {
  const size_t count = seen.objects.size();
  if (count < 4 || count > kFewPoints) return;
  for (size_t k = 0; k < std::min(kMostTriples, count); ++k) {
    PnpPoints three;
    for (const size_t step : {size_t{0}, count / 3, 2 * count / 3}) {
      three.objects.push_back(seen.objects[(k + step) % count]);
      three.tangents.push_back(seen.tangents[(k + step) % count]);
    }
    const std::vector<Rigid3> poses = SolvedPoses(three, cv::SOLVEPNP_P3P);
    starts->insert(starts->end(), poses.begin(), poses.end());
  }
}

// sum |v|^2 / sigma^2 with the points' own sigmas seen from the pose; nullopt: a point behind the
// camera.
std::optional<double> SquareSum(const Camera& camera, const std::vector<ResectionPoint>& points,
                                const Eigen::Vector3d& origin, const Rigid3& cam_from_local) {
  double sum = 0;
  for (const ResectionPoint& point : points) {
    const Eigen::Vector3d in_cam = cam_from_local * (point.world - origin);
    const auto pixel = camera.Project(in_cam);
    if (!pixel) return std::nullopt;
    const double sigma =
        std::hypot(point.sigma_px, camera.focal_px() * point.sigma_m / in_cam.norm());
    sum += (*pixel - point.pixel).squaredNorm() / (sigma * sigma);
  }
  return sum;
}

struct Minimum {
  Candidate candidate;
  double square_sum = 0;
};

// The distinct minima, best first.
std::vector<Minimum> Minima(const Camera& camera, const std::vector<ResectionPoint>& points,
                            const Eigen::Vector3d& origin, const std::vector<Rigid3>& starts) {
  std::vector<Minimum> minima;
  for (const Candidate& candidate : Refine(camera, points, origin, starts)) {
    const auto sum = SquareSum(camera, points, origin, candidate.cam_from_local);
    if (sum) minima.push_back({candidate, *sum});
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [](const auto& a, const auto& b) { return a.square_sum < b.square_sum; });
  std::vector<Minimum> distinct;
  for (const Minimum& minimum : minima) {
    const Eigen::Vector3d center = Center(minimum.candidate.cam_from_local);
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const Minimum& other) {
      return (Center(other.candidate.cam_from_local) - center).norm() < kSamePose * center.norm();
    });
    if (is_new) distinct.push_back(minimum);
  }
  return distinct;
}

// How far off the plane a point's images by the two poses are kDecides apart.
std::optional<double> DecidingDistance(const Camera& camera, const Flatness& flatness,
                                       const Rigid3& a, const Rigid3& b) {
  for (double distance = flatness.extent / 64; distance < 64 * flatness.extent; distance *= 1.25) {
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d place = side * distance * flatness.normal;
      const auto in_a = camera.Project(a * place), in_b = camera.Project(b * place);
      if (in_a && in_b && (*in_a - *in_b).norm() > kDecides) return distance;
    }
  }
  return std::nullopt;
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
  const Eigen::Vector3d spread = EigenOfSymmetric(scatter).values;
  return !(spread[1] > tolerance * tolerance * spread[2]);
}

std::optional<ResectionResult> Resect(const Camera& camera,
                                      const std::vector<ResectionPoint>& points,
                                      const std::optional<Rigid3>& initial) {
  if (AreCollinear(PlacesOf(points))) return std::nullopt;
  const Eigen::Vector3d origin = OriginOf(points);
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

std::optional<Resections> ResectAll(const Camera& camera, const std::vector<ResectionPoint>& points,
                                    const std::optional<Rigid3>& initial,
                                    const std::optional<SurveyedCenter>& place) {
  const auto plain = Resect(camera, points, initial);
  if (points.size() < 4) {
    return plain ? std::optional(Resections{*plain, {}, false, std::nullopt}) : std::nullopt;
  }
  if (AreCollinear(PlacesOf(points))) return std::nullopt;
  const Eigen::Vector3d origin = OriginOf(points);
  const Rigid3 world_from_local{Eigen::Quaterniond::Identity(), origin};
  const Flatness flatness = FlatnessOf(points, origin);
  const PnpPoints seen = ForSolvers(camera, points, origin);
  std::vector<Rigid3> starts;
  if (plain) starts.push_back(plain->cam_from_world * world_from_local);
  if (flatness.is_flat) AddPlanePoses(seen, flatness, &starts);
  AddTriplePoses(seen, &starts);
  std::vector<Minimum> minima = Minima(camera, points, origin, starts);
  if (minima.empty()) return std::nullopt;
  const auto redundancy = static_cast<double>(2 * points.size() - 6);
  const double unit = std::max(1.0, minima[0].square_sum / redundancy);
  const double least = minima[0].square_sum;
  std::erase_if(minima,
                [&](const Minimum& each) { return each.square_sum - least > kReach * unit; });
  const auto center_of = [&](const Minimum& each) {
    return Center(each.candidate.cam_from_local * Inverse(world_from_local));
  };
  if (initial || place) {
    const Eigen::Vector3d wanted = place ? place->position : Center(*initial);
    std::stable_sort(minima.begin(), minima.end(), [&](const Minimum& a, const Minimum& b) {
      return (center_of(a) - wanted).norm() < (center_of(b) - wanted).norm();
    });
    const double nearest = (center_of(minima[0]) - wanted).norm();
    const double allowed = place ? std::max(kFarCenter * place->sigma_m, nearest) : nearest;
    std::erase_if(minima,
                  [&](const Minimum& each) { return (center_of(each) - wanted).norm() > allowed; });
  }
  const Candidate& best = minima[0].candidate;
  const ResectionResult result{best.cam_from_local * Inverse(world_from_local), best.rms_px,
                               Refinement(camera, points, origin, best.cam_from_local).Covariance(),
                               false};
  Resections all{result, {}, flatness.is_flat, std::nullopt};
  for (size_t i = 1; i < minima.size(); ++i) {
    all.seconds.push_back({minima[i].candidate.cam_from_local * Inverse(world_from_local),
                           minima[i].candidate.rms_px,
                           (minima[i].square_sum - minima[0].square_sum) / unit});
  }
  if (!all.seconds.empty()) {
    all.deciding_m =
        DecidingDistance(camera, flatness, best.cam_from_local, minima[1].candidate.cam_from_local);
  }
  return all;
}

}  // namespace insitu
