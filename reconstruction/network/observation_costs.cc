// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/observation_costs.h"

#include <ceres/normal_prior.h>

#include <Eigen/LU>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

// d q / d (left increment of half the angle), as ceres::EigenQuaternionManifold has it; its columns
// are orthonormal, so its transpose inverts it.
Eigen::Matrix<double, 4, 3> QuaternionFromHalfAngle(const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 4, 3> matrix;
  matrix.topRows<3>() = q.w() * Eigen::Matrix3d::Identity() - CrossMatrix(q.vec());
  matrix.row(3) = -q.vec().transpose();
  return matrix;
}

struct SightOffEdge {
  double px_per_radian, sigma_px;

  template <typename T>
  bool operator()(const T* rotation, const T* center, const T* from, const T* to, const T* sight,
                  T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> cam_from_local(rotation);
    const Eigen::Map<const Vector3> c(center), a(from), b(to), sight_in_cam(sight);
    const Vector3 normal = cam_from_local * (a - c).cross(b - c).normalized();
    residual[0] = normal.dot(sight_in_cam) * T(px_per_radian / sigma_px);
    return true;
  }
};

double PixelsPerRadian(const Camera& camera, const Eigen::Vector2d& pixel) {
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  INSITU_CHECK(camera.Project(camera.Unproject(pixel), &pixel_from_point));
  return pixel_from_point.norm() / std::sqrt(2.0);
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
  if (!(lens_parameters[0] > 0)) return false;  // a step too far, not a lens

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

EdgeCost::EdgeCost(const Camera& camera, const std::vector<double>* held_parameters,
                   const Eigen::Vector2d& observed_px, double sigma_px)
    : camera_(camera),
      held_parameters_(held_parameters),
      observed_(observed_px),
      residual_of_sight_(new ceres::AutoDiffCostFunction<SightOffEdge, 1, 4, 3, 3, 3, 3>(
          new SightOffEdge{PixelsPerRadian(camera, observed_px), sigma_px})) {
  set_num_residuals(1);
  *mutable_parameter_block_sizes() = {4, 3, 3, 3};
  if (!held_parameters) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(camera.intrinsics().size()));
  }
}

bool EdgeCost::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const double* lens = held_parameters_ ? held_parameters_->data() : parameters[4];
  if (!(lens[0] > 0 && lens[1] > 0)) return false;  // a step too far, not a lens
  const auto lens_size = static_cast<Eigen::Index>(camera_.intrinsics().size());
  const Camera camera(camera_.lens_model(), std::vector<double>(lens, lens + lens_size),
                      camera_.width(), camera_.height());
  const Eigen::Vector3d sight = camera.Unproject(observed_);
  const double* blocks[] = {parameters[0], parameters[1], parameters[2], parameters[3],
                            sight.data()};
  if (!jacobians) return residual_of_sight_->Evaluate(blocks, residuals, nullptr);
  Eigen::RowVector3d by_sight;
  double* derivatives[] = {jacobians[0], jacobians[1], jacobians[2], jacobians[3], by_sight.data()};
  if (!residual_of_sight_->Evaluate(blocks, residuals, derivatives)) return false;
  if (held_parameters_ || !jacobians[4]) return true;
  // The pixel stays while the lens changes, so its sight turns: dv = -(dq/dv)^+ dq/dl.
  Eigen::Matrix<double, 2, 3> pixel_from_sight;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> pixel_from_lens(2, lens_size);
  INSITU_CHECK(camera.ProjectWith(lens, sight, &pixel_from_sight, pixel_from_lens.data()));
  const Eigen::Matrix2d gram = pixel_from_sight * pixel_from_sight.transpose();
  Eigen::Map<Eigen::RowVectorXd>(jacobians[4], lens_size) =
      -by_sight * pixel_from_sight.transpose() * gram.inverse() * pixel_from_lens;
  return true;
}

ceres::CostFunction* LensCost(const LensObservation& lens, const std::vector<bool>& is_free) {
  std::vector<int> free;
  for (size_t i = 0; i < is_free.size(); ++i) {
    if (is_free[i]) free.push_back(static_cast<int>(i));
  }
  const std::optional<Eigen::MatrixXd> decorrelated = Decorrelation(lens.covariance(free, free));
  INSITU_CHECK(decorrelated);
  Eigen::MatrixXd by_parameter =
      Eigen::MatrixXd::Zero(decorrelated->rows(), static_cast<Eigen::Index>(lens.values.size()));
  for (size_t i = 0; i < free.size(); ++i) {
    by_parameter.col(free[i]) = decorrelated->col(static_cast<Eigen::Index>(i));
  }
  const Eigen::Map<const Eigen::VectorXd> values(lens.values.data(),
                                                 static_cast<Eigen::Index>(lens.values.size()));
  return new ceres::NormalPrior(by_parameter, values);
}

}  // namespace insitu
