// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/lens_residual.h"

#include <ceres/jet.h>

#include "calibration/files/error.h"
#include "calibration/lens/metric_polynomials.h"

namespace insitu {
namespace {

constexpr int kMetricParameters = 10;

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

template <typename T>
Vector2<T> MetricResidual(const MetricCamera& camera, const T* parameters,
                          const Eigen::Matrix<T, 3, 1>& point, const Eigen::Vector2d& observed_px) {
  const Eigen::Vector2d offset = (observed_px - camera.origin_px).cwiseProduct(camera.pixel_mm);
  const Eigen::Vector2d measured_mm(offset.x(), -offset.y());
  const T scale = parameters[0] / point.z();
  const Vector2<T> ideal_mm(scale * point.x(), -scale * point.y());
  const Vector2<T> residual_mm =
      camera.model == MetricModel::kBackwardBrown
          ? Vector2<T>(ideal_mm - CorrectBackwardBrown(parameters, measured_mm))
          : Vector2<T>(DistortBalancedRadial(parameters, camera.balanced_radius_mm, ideal_mm) -
                       measured_mm.cast<T>());
  return {residual_mm.x() / camera.pixel_mm.x(), -residual_mm.y() / camera.pixel_mm.y()};
}

bool Residual(const MetricCamera& camera, const double* parameters, const Eigen::Vector3d& point,
              const Eigen::Vector2d& observed_px, Eigen::Vector2d* residual_px,
              const LensDerivatives& derivatives) {
  if (!(point.z() > 0)) return false;
  if (!derivatives.by_point && !derivatives.by_parameters) {
    *residual_px = MetricResidual<double>(camera, parameters, point, observed_px);
    return true;
  }
  using Jet = ceres::Jet<double, 3 + kMetricParameters>;
  Eigen::Matrix<Jet, 3, 1> point_jet;
  Jet parameter_jets[kMetricParameters];
  for (int i = 0; i < 3; ++i) point_jet[i] = Jet(point[i], i);
  for (int i = 0; i < kMetricParameters; ++i) parameter_jets[i] = Jet(parameters[i], 3 + i);
  const Vector2<Jet> residual = MetricResidual<Jet>(camera, parameter_jets, point_jet, observed_px);
  for (int row = 0; row < 2; ++row) {
    (*residual_px)[row] = residual[row].a;
    if (derivatives.by_point) derivatives.by_point->row(row) = residual[row].v.head<3>();
    if (derivatives.by_parameters) {
      derivatives.by_parameters->row(row) = residual[row].v.tail<kMetricParameters>();
    }
  }
  return true;
}

bool Residual(const Camera& camera, const double* parameters, const Eigen::Vector3d& point,
              const Eigen::Vector2d& observed_px, Eigen::Vector2d* residual_px,
              const LensDerivatives& derivatives) {
  const auto pixel =
      camera.ProjectWith(parameters, point, derivatives.by_point,
                         derivatives.by_parameters ? derivatives.by_parameters->data() : nullptr);
  if (!pixel) return false;
  *residual_px = *pixel - observed_px;
  return true;
}

}  // namespace

std::vector<double> LensParameters(const Lens& lens) {
  if (const auto* camera = std::get_if<Camera>(&lens)) return camera->intrinsics();
  const std::vector<double>& parameters = std::get<MetricCamera>(lens).parameters;
  INSITU_CHECK(parameters.size() == kMetricParameters);
  return parameters;
}

std::vector<std::string> LensParameterNames(const Lens& lens) {
  if (const auto* camera = std::get_if<Camera>(&lens)) return camera->IntrinsicsNames();
  return ParameterNames(std::get<MetricCamera>(lens).model);
}

Lens WithParameters(const Lens& lens, const std::vector<double>& parameters) {
  if (const auto* camera = std::get_if<Camera>(&lens)) {
    return Camera(camera->lens_model(), parameters, camera->width(), camera->height());
  }
  MetricCamera metric = std::get<MetricCamera>(lens);
  metric.parameters = parameters;
  return metric;
}

bool LensResidual(const Lens& lens, const double* parameters, const Eigen::Vector3d& point_in_cam,
                  const Eigen::Vector2d& observed_px, Eigen::Vector2d* residual_px,
                  const LensDerivatives& derivatives) {
  if (derivatives.by_parameters) {
    const auto* camera = std::get_if<Camera>(&lens);
    const auto count = camera ? static_cast<int>(camera->intrinsics().size()) : kMetricParameters;
    derivatives.by_parameters->resize(2, count);
  }
  return std::visit(
      [&](const auto& model) {
        return Residual(model, parameters, point_in_cam, observed_px, residual_px, derivatives);
      },
      lens);
}

}  // namespace insitu
