// SPDX-License-Identifier: GPL-3.0-or-later
// The observation equations of resection and joint adjustment as Ceres residuals, each divided by
// its sigma. Coordinates are about a local origin near the site.
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/cost_function_to_functor.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Geometry>

#include "calibration/camera.h"

namespace insitu {

// Pixel of a point in the camera frame, through the lens; infeasible behind the camera.
class PixelOfPoint : public ceres::SizedCostFunction<2, 3> {
 public:
  explicit PixelOfPoint(const Camera& camera) : camera_(camera) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Vector3d point_in_cam(parameters[0]);
    Eigen::Matrix<double, 2, 3> pixel_from_point;
    const auto pixel = camera_.Project(point_in_cam, &pixel_from_point);
    if (!pixel) return false;
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = *pixel;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>(jacobians[0], 2, 3) =
          pixel_from_point;
    }
    return true;
  }

 private:
  Camera camera_;
};

// A mark on a photograph: (pixel(R (X - C)) - observed) / sigma. Unknowns: R as a quaternion
// (x, y, z, w), camera centre C, point X. [Durisch92, §3.5]
class MarkCost {
 public:
  MarkCost(const Camera& camera, const Eigen::Vector2d& observed_px, double sigma_px)
      : pixel_of_point_(new PixelOfPoint(camera)), observed_(observed_px), sigma_(sigma_px) {}

  template <typename T>
  bool operator()(const T* rotation, const T* center, const T* point, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> cam_from_world(rotation);
    const Vector3 point_in_cam =
        cam_from_world * (Eigen::Map<const Vector3>(point) - Eigen::Map<const Vector3>(center));
    T pixel[2];
    if (!pixel_of_point_(point_in_cam.data(), pixel)) return false;
    for (int i = 0; i < 2; ++i) residual[i] = (pixel[i] - observed_[i]) / sigma_;
    return true;
  }

  static ceres::CostFunction* Create(const Camera& camera, const Eigen::Vector2d& observed_px,
                                     double sigma_px) {
    return new ceres::AutoDiffCostFunction<MarkCost, 2, 4, 3, 3>(
        new MarkCost(camera, observed_px, sigma_px));
  }

 private:
  ceres::CostFunctionToFunctor<2, 3> pixel_of_point_;
  Eigen::Vector2d observed_;
  double sigma_;
};

// A surveyed point: (X - surveyed) / sigma, per axis.
struct ControlCost {
  Eigen::Vector3d surveyed, sigma;  // [m]

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (point[i] - surveyed[i]) / sigma[i];
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& surveyed,
                                     const Eigen::Vector3d& sigma) {
    return new ceres::AutoDiffCostFunction<ControlCost, 3, 3>(new ControlCost{surveyed, sigma});
  }
};

// A vertex on its polygon's plane: (n . (X - centroid) - d) / sigma. The offset d is counted about
// the polygon's centroid, so that it hardly correlates with the normal n.
struct PlaneCost {
  Eigen::Vector3d centroid;  // [m], fixed
  double sigma = 0;          // [m]

  template <typename T>
  bool operator()(const T* normal, const T* offset, const T* point, T* residual) const {
    residual[0] = -offset[0];
    for (int i = 0; i < 3; ++i) residual[0] += normal[i] * (point[i] - centroid[i]);
    residual[0] /= T(sigma);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& centroid, double sigma) {
    return new ceres::AutoDiffCostFunction<PlaneCost, 1, 3, 1, 3>(new PlaneCost{centroid, sigma});
  }
};

// Two points on a line along a direction u: the part of (to - from) across u, along two fixed
// axes orthogonal to the start direction, over sigma. [Durisch92, §4.1]
struct DirectionCost {
  Eigen::Matrix<double, 2, 3> axes;  // rows: unit, orthogonal
  double sigma = 0;                  // [m]

  template <typename T>
  bool operator()(const T* direction, const T* from, const T* to, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector3> u(direction);
    const Vector3 step = Eigen::Map<const Vector3>(to) - Eigen::Map<const Vector3>(from);
    const Vector3 across = step - u * u.dot(step);
    Eigen::Map<Eigen::Matrix<T, 2, 1>> result(residual);
    result = axes.cast<T>() * across / T(sigma);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& start, double sigma) {
    const Eigen::Vector3d first = start.unitOrthogonal();
    Eigen::Matrix<double, 2, 3> axes;
    axes << first.transpose(), start.cross(first).transpose();
    return new ceres::AutoDiffCostFunction<DirectionCost, 2, 3, 3, 3>(
        new DirectionCost{axes, sigma});
  }
};

}  // namespace insitu
