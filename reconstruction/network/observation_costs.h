// SPDX-License-Identifier: GPL-3.0-or-later
// The observation equations of resection and joint adjustment as Ceres residuals, each divided by
// its sigma. Coordinates are about a local origin near the site. Rotations are quaternions
// cam_from_local (x, y, z, w).
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/cost_function.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "calibration/lens/lens_residual.h"
#include "reconstruction/network/network.h"

namespace insitu {

// A mark on a photograph: residual of R (X - C) through the lens, over sigma. Unknowns: R, camera
// centre C, point X, and all parameters of the lens if it is adjusted. [Durisch92, §3.5]
class MarkCost : public ceres::CostFunction {
 public:
  // `held_parameters`: of a lens that is not adjusted, else null. Both must outlive the cost.
  MarkCost(const Lens& lens, const std::vector<double>* held_parameters,
           const Eigen::Vector2d& observed_px, double sigma_px);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const Lens& lens_;
  const std::vector<double>* held_parameters_;
  Eigen::Vector2d observed_;
  double sigma_;
};

// A pixel on the image of the edge from A to B: the angle between its line of sight and the plane
// of C, A, B, times the pixels per radian there, over sigma. Unknowns: R, C, A, B, and all
// parameters of the lens if it is adjusted.
class EdgeCost : public ceres::CostFunction {
 public:
  // As MarkCost.
  EdgeCost(const Camera& camera, const std::vector<double>* held_parameters,
           const Eigen::Vector2d& observed_px, double sigma_px);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const Camera& camera_;
  const std::vector<double>* held_parameters_;
  Eigen::Vector2d observed_;
  std::unique_ptr<ceres::CostFunction> residual_of_sight_;  // of R, C, A, B and the sight in cam
};

// A surveyed place, of a point or of a camera's centre: (X - surveyed) / sigma, per axis.
struct PositionCost {
  Eigen::Vector3d surveyed, sigma;  // [m]

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (point[i] - surveyed[i]) / sigma[i];
    return true;
  }
};

// The same of an antenna, at an arm in the camera's axes from its centre.
struct AntennaCost {
  PositionCost position;
  Eigen::Vector3d arm;  // [m]

  template <typename T>
  bool operator()(const T* cam_from_local, const T* center, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(cam_from_local);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> c(center);
    const Eigen::Matrix<T, 3, 1> antenna = c + rotation.conjugate() * arm.cast<T>();
    return position(antenna.data(), residual);
  }
};

// One component of a rotation's left increment [rad] from where it was, times a weight.
struct TurnCost {
  int axis = 0;
  Eigen::Quaterniond start;
  double weight = 0;  // [1/rad]

  template <typename T>
  bool operator()(const T* rotation, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(rotation);
    residual[0] = T(2 * weight) * (q * start.conjugate().cast<T>()).vec()[axis];
    return true;
  }
};

// One coordinate of a place kept near a value: (X_axis - value) weight.
struct CoordinateCost {
  int axis = 0;
  double value = 0;   // [m]
  double weight = 0;  // [1/m]

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = (point[axis] - T(value)) * T(weight);
    return true;
  }
};

// A vertex on its polygon's plane: (n . (X - centroid) - d - distance) / sigma. The offset d is
// counted about the polygon's centroid, so that it hardly correlates with the normal n.
struct PlaneCost {
  Eigen::Vector3d centroid;  // [m], fixed
  double distance = 0;       // [m]
  double sigma = 0;          // [m]

  template <typename T>
  bool operator()(const T* normal, const T* offset, const T* point, T* residual) const {
    residual[0] = -offset[0] - T(distance);
    for (int i = 0; i < 3; ++i) residual[0] += normal[i] * (point[i] - centroid[i]);
    residual[0] /= T(sigma);
    return true;
  }
};

// Two points on a line along a direction u: the part of (to - from) across u, along two fixed
// axes orthogonal to the start direction, over sigma. [Durisch92, §4.1]
struct DirectionCost {
  Eigen::Matrix<double, 2, 3> axes;  // rows: unit, orthogonal
  Eigen::Vector2d observed;          // [m]
  double sigma = 0;                  // [m]

  template <typename T>
  bool operator()(const T* direction, const T* from, const T* to, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector3> u(direction);
    const Vector3 step = Eigen::Map<const Vector3>(to) - Eigen::Map<const Vector3>(from);
    const Vector3 across = step - u * u.dot(step);
    Eigen::Map<Eigen::Matrix<T, 2, 1>> result(residual);
    result = (axes.cast<T>() * across - observed.cast<T>()) / T(sigma);
    return true;
  }
};

// (|to - from| - distance) / sigma.
struct DistanceCost {
  double distance = 0, sigma = 0;  // [m]

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Vector3 step = Eigen::Map<const Vector3>(to) - Eigen::Map<const Vector3>(from);
    residual[0] = (step.norm() - T(distance)) / T(sigma);
    return true;
  }
};

// ((to - from) . u - height) / sigma.
struct HeightCost {
  double height = 0, sigma = 0;  // [m]

  template <typename T>
  bool operator()(const T* direction, const T* from, const T* to, T* residual) const {
    residual[0] = T(-height);
    for (int i = 0; i < 3; ++i) residual[0] += direction[i] * (to[i] - from[i]);
    residual[0] /= T(sigma);
    return true;
  }
};

// Angle between two unit vectors a and b [rad]: parallel, the parts of b across a along two fixed
// axes; perpendicular, their product; over sigma. A vector is one unknown, or the edge between two
// points, which are then two; two edges may share a point.
struct AngleCost {
  std::vector<int> places;  // of the vectors' unknowns, one after the other, among the blocks
  bool is_edge_first = false, is_edge_second = false;
  bool is_parallel = false;
  Eigen::Matrix<double, 2, 3> axes;  // rows: unit, orthogonal to the start of a
  Eigen::Vector2d observed;          // [rad]
  double sigma = 0;                  // [rad]

  template <typename T>
  bool operator()(T const* const* blocks, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    int next = 0;
    const auto unit = [&](bool is_edge) -> Vector3 {
      const Vector3 first = Eigen::Map<const Vector3>(blocks[places[next++]]);
      if (!is_edge) return first;
      return (Eigen::Map<const Vector3>(blocks[places[next++]]) - first).normalized();
    };
    const Vector3 a = unit(is_edge_first), b = unit(is_edge_second);
    if (is_parallel) {
      Eigen::Map<Eigen::Matrix<T, 2, 1>> result(residual);
      result = (axes.cast<T>() * a.cross(b) - observed.cast<T>()) / T(sigma);
    } else {
      residual[0] = (a.dot(b) - T(observed[0])) / T(sigma);
    }
    return true;
  }
};

// The free parameters less their observed values, uncorrelated and over their sigma: row i is the
// i-th given those before it.
ceres::CostFunction* LensCost(const LensObservation& lens, const std::vector<bool>& is_free);

// Two rows orthogonal to `unit` and to one another.
Eigen::Matrix<double, 2, 3> AxesAcross(const Eigen::Vector3d& unit);

}  // namespace insitu
