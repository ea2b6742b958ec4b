// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/metric_camera.h"

#include "calibration/files/error.h"
#include "calibration/lens/invert_plane.h"
#include "calibration/lens/metric_polynomials.h"

namespace insitu {
namespace {

constexpr int kParameters = 10;
constexpr double kTolerance = 1e-12;  // of the image's half diagonal

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

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
  const double* p = camera.parameters.data();
  const Eigen::Vector2d ideal =
      p[0] / point_in_cam.z() * Eigen::Vector2d(point_in_cam.x(), -point_in_cam.y());
  std::optional<Eigen::Vector2d> measured;
  if (camera.model == MetricModel::kBalancedRadial) {
    measured = DistortBalancedRadial(p, camera.balanced_radius_mm, ideal);
  } else {
    measured =
        InvertPlane([&]<typename T>(const Vector2<T>& m) { return CorrectBackwardBrown(p, m); },
                    ideal, ideal + PrincipalPoint(camera), Tolerance(camera));
  }
  if (!measured) return std::nullopt;
  const Eigen::Vector2d offset = measured->cwiseQuotient(camera.pixel_mm);
  return camera.origin_px + Eigen::Vector2d(offset.x(), -offset.y());
}

std::optional<Eigen::Vector3d> UnprojectMetric(const MetricCamera& camera,
                                               const Eigen::Vector2d& pixel) {
  Check(camera);
  const double* p = camera.parameters.data();
  const Eigen::Vector2d offset = (pixel - camera.origin_px).cwiseProduct(camera.pixel_mm);
  const Eigen::Vector2d measured(offset.x(), -offset.y());
  std::optional<Eigen::Vector2d> ideal;
  if (camera.model == MetricModel::kBackwardBrown) {
    ideal = CorrectBackwardBrown(p, measured);
  } else {
    const auto map = [&]<typename T>(const Vector2<T>& i) {
      return DistortBalancedRadial(p, camera.balanced_radius_mm, i);
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
