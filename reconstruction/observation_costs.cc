// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/observation_costs.h"

namespace insitu {
namespace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

// d q / d (left increment of half the angle), as ceres::EigenQuaternionManifold has it; its columns
// are orthonormal, so its transpose inverts it.
Eigen::Matrix<double, 4, 3> QuaternionFromHalfAngle(const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 4, 3> matrix;
  matrix.topRows<3>() = q.w() * Eigen::Matrix3d::Identity() - CrossMatrix(q.vec());
  matrix.row(3) = -q.vec().transpose();
  return matrix;
}

}  // namespace

Eigen::Matrix<double, 2, 3> AxesAcross(const Eigen::Vector3d& unit) {
  const Eigen::Vector3d first = unit.unitOrthogonal();
  Eigen::Matrix<double, 2, 3> axes;
  axes << first.transpose(), unit.cross(first).transpose();
  return axes;
}

MarkCost::MarkCost(const Lens& lens, const std::vector<double>* held_parameters,
                   const Eigen::Vector2d& observed_px, double sigma_px)
    : lens_(lens), held_parameters_(held_parameters), observed_(observed_px), sigma_(sigma_px) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {4, 3, 3};
  if (!held_parameters) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(LensParameters(lens).size()));
  }
}

bool MarkCost::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const Eigen::Quaterniond cam_from_local(parameters[0]);
  const Eigen::Vector3d point_from_center =
      Eigen::Vector3d(parameters[2]) - Eigen::Vector3d(parameters[1]);
  const Eigen::Vector3d point_in_cam = cam_from_local * point_from_center;
  const double* lens_parameters = held_parameters_ ? held_parameters_->data() : parameters[3];

  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_lens;
  LensDerivatives derivatives;
  if (jacobians) derivatives.by_point = &by_point;
  if (jacobians && !held_parameters_ && jacobians[3]) derivatives.by_parameters = &by_lens;
  Eigen::Vector2d residual;
  if (!LensResidual(lens_, lens_parameters, point_in_cam, observed_, &residual, derivatives)) {
    return false;
  }
  Eigen::Map<Eigen::Vector2d>(residuals, 2) = residual / sigma_;
  if (!jacobians) return true;

  by_point /= sigma_;
  const Eigen::Matrix<double, 2, 3> by_position = by_point * cam_from_local.toRotationMatrix();
  using RowMajor23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
  using RowMajor24 = Eigen::Matrix<double, 2, 4, Eigen::RowMajor>;
  if (jacobians[0]) {
    Eigen::Map<RowMajor24>(jacobians[0], 2, 4) =
        -2 * by_point * CrossMatrix(point_in_cam) *
        QuaternionFromHalfAngle(cam_from_local).transpose();
  }
  if (jacobians[1]) Eigen::Map<RowMajor23>(jacobians[1], 2, 3) = -by_position;
  if (jacobians[2]) Eigen::Map<RowMajor23>(jacobians[2], 2, 3) = by_position;
  if (derivatives.by_parameters) {
    Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[3], 2, by_lens.cols()) = by_lens / sigma_;
  }
  return true;
}

}  // namespace insitu
