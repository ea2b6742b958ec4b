// SPDX-License-Identifier: GPL-3.0-or-later
// The polynomials of MetricModel, for numbers and for derivatives: of the position, the parameters,
// or both. Internal to metric_camera.cc and calibration/lens/lens_residual.cc.
#pragma once

#include <Eigen/Core>

namespace insitu {

// What a parameter times a coordinate is.
template <typename P, typename T>
using Product = decltype(P() * T());

// Measured to ideal position about the principal point [mm]. See MetricModel::kBackwardBrown.
template <typename P, typename T>
Eigen::Matrix<Product<P, T>, 2, 1> CorrectBackwardBrown(const P* p,
                                                        const Eigen::Matrix<T, 2, 1>& measured) {
  using R = Product<P, T>;
  const R y = measured.y() - p[2];
  const R x = (1.0 + p[8]) * (measured.x() - p[1]) + p[9] * y;
  const R r2 = x * x + y * y;
  const R radial = r2 * (p[3] + r2 * (p[4] + r2 * p[5]));
  return {x + x * radial + p[6] * (r2 + 2.0 * x * x) + 2.0 * p[7] * x * y,
          y + y * radial + 2.0 * p[6] * x * y + p[7] * (r2 + 2.0 * y * y)};
}

// Ideal to measured position [mm]. See MetricModel::kBalancedRadial.
template <typename P, typename T>
Eigen::Matrix<Product<P, T>, 2, 1> DistortBalancedRadial(const P* p, double balanced_radius,
                                                         const Eigen::Matrix<T, 2, 1>& ideal) {
  using R = Product<P, T>;
  const T x = ideal.x(), y = ideal.y();
  const T r2 = x * x + y * y;
  const double b2 = balanced_radius * balanced_radius;
  const R d = p[3] * (r2 - b2) + p[4] * (r2 * r2 - b2 * b2) + p[5] * (r2 * r2 * r2 - b2 * b2 * b2);
  return {x + p[1] + x * d + p[6] * (r2 + 2.0 * x * x) + 2.0 * p[7] * x * y + p[8] * x + p[9] * y,
          y + p[2] + y * d + p[7] * (r2 + 2.0 * y * y) + 2.0 * p[6] * x * y};
}

}  // namespace insitu
