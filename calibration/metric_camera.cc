// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/metric_camera.h"

#include "calibration/error.h"
#include "calibration/invert_plane.h"

namespace insitu {
namespace {

constexpr int kParameters = 10;
constexpr double kTolerance = 1e-12;  // of the image's half diagonal

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

// Measured to ideal position about the principal point [mm]. See MetricModel::kBackwardBrown.
template <typename T>
Vector2<T> Corrected(const std::vector<double>& p, const Vector2<T>& measured) {
  const T y = measured.y() - p[2];
  const T x = (1 + p[8]) * (measured.x() - p[1]) + p[9] * y;
  const T r2 = x * x + y * y;
  const T radial = r2 * (p[3] + r2 * (p[4] + r2 * p[5]));
  return {x + x * radial + p[6] * (r2 + 2.0 * x * x) + 2 * p[7] * x * y,
          y + y * radial + 2 * p[6] * x * y + p[7] * (r2 + 2.0 * y * y)};
}

// Ideal to measured position [mm]. See MetricModel::kBalancedRadial.
template <typename T>
Vector2<T> Distorted(const std::vector<double>& p, double balanced_radius,
                     const Vector2<T>& ideal) {
  const T x = ideal.x(), y = ideal.y();
  const T r2 = x * x + y * y;
  const double b2 = balanced_radius * balanced_radius, b4 = b2 * b2;
  const T d = p[3] * (r2 - b2) + p[4] * (r2 * r2 - b4) + p[5] * (r2 * r2 * r2 - b2 * b4);
  return {x + p[1] + x * d + p[6] * (r2 + 2.0 * x * x) + 2 * p[7] * x * y + p[8] * x + p[9] * y,
          y + p[2] + y * d + p[7] * (r2 + 2.0 * y * y) + 2 * p[6] * x * y};
}

void Check(const MetricCamera& camera) {
  INSITU_CHECK(camera.parameters.size() == kParameters && camera.parameters[0] > 0);
  INSITU_CHECK(camera.pixel_mm.minCoeff() > 0);
}

double Tolerance(const MetricCamera& camera) {
  return kTolerance * 0.5 *
         Eigen::Array2d(camera.width, camera.height).matrix().cwiseProduct(camera.pixel_mm).norm();
}

Eigen::Vector2d PrincipalPoint(const MetricCamera& camera) {
  return {camera.parameters[1], camera.parameters[2]};
}

}  // namespace

const std::vector<std::string>& ParameterNames(MetricModel model) {
  static const std::vector<std::string> kBrown = {"c",  "xp", "yp", "K1",     "K2",
                                                  "K3", "P1", "P2", "aspect", "skew"};
  static const std::vector<std::string> kBalanced = {"c",  "xh", "yh", "A1", "A2",
                                                     "A3", "B1", "B2", "C1", "C2"};
  return model == MetricModel::kBackwardBrown ? kBrown : kBalanced;
}

std::optional<Eigen::Vector2d> ProjectMetric(const MetricCamera& camera,
                                             const Eigen::Vector3d& point_in_cam) {
  Check(camera);
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const std::vector<double>& p = camera.parameters;
  const Eigen::Vector2d ideal =
      p[0] / point_in_cam.z() * Eigen::Vector2d(point_in_cam.x(), -point_in_cam.y());
  std::optional<Eigen::Vector2d> measured;
  if (camera.model == MetricModel::kBalancedRadial) {
    measured = Distorted<double>(p, camera.balanced_radius_mm, ideal);
  } else {
    measured = InvertPlane([&]<typename T>(const Vector2<T>& m) { return Corrected<T>(p, m); },
                           ideal, ideal + PrincipalPoint(camera), Tolerance(camera));
  }
  if (!measured) return std::nullopt;
  const Eigen::Vector2d offset = measured->cwiseQuotient(camera.pixel_mm);
  return camera.origin_px + Eigen::Vector2d(offset.x(), -offset.y());
}

std::optional<Eigen::Vector3d> UnprojectMetric(const MetricCamera& camera,
                                               const Eigen::Vector2d& pixel) {
  Check(camera);
  const std::vector<double>& p = camera.parameters;
  const Eigen::Vector2d offset = (pixel - camera.origin_px).cwiseProduct(camera.pixel_mm);
  const Eigen::Vector2d measured(offset.x(), -offset.y());
  std::optional<Eigen::Vector2d> ideal;
  if (camera.model == MetricModel::kBackwardBrown) {
    ideal = Corrected<double>(p, measured);
  } else {
    const auto map = [&]<typename T>(const Vector2<T>& i) {
      return Distorted<T>(p, camera.balanced_radius_mm, i);
    };
    ideal = InvertPlane(map, measured, measured - PrincipalPoint(camera), Tolerance(camera));
  }
  if (!ideal) return std::nullopt;
  return Eigen::Vector3d(ideal->x(), -ideal->y(), p[0]).normalized();
}

std::optional<CameraFit> FitMetricCamera(const MetricCamera& camera) {
  return FitCamera([&](const Eigen::Vector2d& pixel) { return UnprojectMetric(camera, pixel); },
                   camera.width, camera.height);
}

}  // namespace insitu
