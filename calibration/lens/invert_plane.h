// SPDX-License-Identifier: GPL-3.0-or-later
// Inverting a smooth map of the image plane that is nearly the identity, as distortions are.
#pragma once

#include <ceres/jet.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>

namespace insitu {

// The position p with map(p) = value, by Newton's method from `start`; `map` takes and gives
// Eigen::Matrix<T, 2, 1> for T double or ceres::Jet. nullopt: no convergence to `tolerance`, or to
// a place where the map has turned over (determinant <= 0).
template <typename Map>
std::optional<Eigen::Vector2d> InvertPlane(const Map& map, const Eigen::Vector2d& value,
                                           const Eigen::Vector2d& start, double tolerance) {
  using Jet = ceres::Jet<double, 2>;
  constexpr int kMostSteps = 30;
  Eigen::Vector2d p = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Matrix<Jet, 2, 1> mapped =
        map(Eigen::Matrix<Jet, 2, 1>(Jet(p.x(), 0), Jet(p.y(), 1)));
    Eigen::Matrix2d jacobian;
    jacobian << mapped.x().v.transpose(), mapped.y().v.transpose();
    const Eigen::Vector2d rest = value - Eigen::Vector2d(mapped.x().a, mapped.y().a);
    if (!rest.allFinite() || !(jacobian.determinant() > 0)) return std::nullopt;
    if (rest.norm() < tolerance) return p;
    p += jacobian.inverse() * rest;
  }
  return std::nullopt;
}

}  // namespace insitu
