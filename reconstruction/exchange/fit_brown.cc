// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/fit_brown.h"

#include <cmath>
#include <vector>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "calibration/lens/fit_camera.h"
#include "calibration/lens/lens_residual.h"

namespace insitu {
namespace {

constexpr int kGrid = 24;  // places along either side of the frame
constexpr int kFree = 9;   // all parameters but the skew, which is the last

struct Place {
  Eigen::Vector2d pixel;
  Eigen::Vector3d sight;  // unit, camera frame
};

std::vector<Place> Places(const Camera& camera) {
  std::vector<Place> places;
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; column < kGrid; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / kGrid * camera.width() - 0.5,
                                  (row + 0.5) / kGrid * camera.height() - 0.5);
      const Eigen::Vector3d sight = camera.Unproject(pixel);
      if (!sight.allFinite() || sight.head<2>().norm() > kLargestTangent * sight.z()) continue;
      places.push_back({pixel, sight});
    }
  }
  return places;
}

struct Equations {
  Eigen::MatrixXd jacobian;   // [px], columns scaled by `scale`
  Eigen::VectorXd residuals;  // [px]
};

// Columns differ by many powers of ten: each is of a parameter's change that moves the frame's
// corner by about a millimetre.
Eigen::VectorXd Scale(const MetricCamera& lens) {
  const double r = lens.pixel_mm.x() * std::hypot(lens.width, lens.height) / 2;
  Eigen::VectorXd scale(kFree);
  scale << 1, 1, 1, std::pow(r, -3), std::pow(r, -5), std::pow(r, -7), std::pow(r, -2),
      std::pow(r, -2), 1 / r;
  return scale;
}

Equations Linearized(const MetricCamera& lens, const std::vector<Place>& places) {
  const auto rows = static_cast<Eigen::Index>(2 * places.size());
  Equations equations{Eigen::MatrixXd(rows, kFree), Eigen::VectorXd(rows)};
  const Eigen::VectorXd scale = Scale(lens);
  for (size_t i = 0; i < places.size(); ++i) {
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> derivatives;
    LensDerivatives wanted;
    wanted.by_parameters = &derivatives;
    LensResidual(lens, lens.parameters.data(), places[i].sight, places[i].pixel, &residual, wanted);
    const auto row = static_cast<Eigen::Index>(2 * i);
    equations.residuals.segment<2>(row) = residual;
    equations.jacobian.middleRows<2>(row) = derivatives.leftCols(kFree) * scale.asDiagonal();
  }
  return equations;
}

MetricCamera StartLens(const Camera& camera, double sensor_height_mm) {
  const double pixel_mm = sensor_height_mm / camera.height();
  MetricCamera lens;
  lens.width = camera.width();
  lens.height = camera.height();
  lens.pixel_mm.setConstant(pixel_mm);
  lens.origin_px.setConstant(-0.5);
  lens.parameters.assign(10, 0);
  lens.parameters[0] = camera.focal_px() * pixel_mm;
  lens.parameters[1] = pixel_mm * camera.width() / 2;
  lens.parameters[2] = -pixel_mm * camera.height() / 2;
  return lens;
}

}  // namespace

std::optional<BrownFit> FitBrown(const Camera& camera, double sensor_height_mm) {
  INSITU_CHECK(sensor_height_mm > 0);
  const std::vector<Place> places = Places(camera);
  if (places.size() < kGrid) return std::nullopt;
  BrownFit fit;
  fit.lens = StartLens(camera, sensor_height_mm);
  const Eigen::VectorXd scale = Scale(fit.lens);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Equations equations = Linearized(fit.lens, places);
    const Eigen::VectorXd step = -SolveLeastSquares(equations.jacobian, equations.residuals).x;
    if (!step.allFinite()) return std::nullopt;
    for (int i = 0; i < kFree; ++i) fit.lens.parameters[i] += scale[i] * step[i];
    if (step.norm() > 1e-10) continue;
    const Eigen::VectorXd residuals = Linearized(fit.lens, places).residuals;
    const auto by_place = residuals.reshaped(2, residuals.size() / 2).colwise().norm();
    fit.rms_px = residuals.norm() / std::sqrt(static_cast<double>(places.size()));
    fit.largest_px = by_place.maxCoeff();
    return fit;
  }
  return std::nullopt;
}

}  // namespace insitu
