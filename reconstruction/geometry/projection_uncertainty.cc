// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/projection_uncertainty.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

std::optional<ImageUncertainty> ProjectBoth(const PosedCamera& posed,
                                            const Eigen::MatrixXd& covariance,
                                            const Eigen::Vector3d& world,
                                            const PointUncertainty* uncertain) {
  const Camera& camera = posed.camera;
  const auto intrinsics = static_cast<Eigen::Index>(camera.intrinsics().size());
  INSITU_CHECK(covariance.rows() == covariance.cols());
  INSITU_CHECK(covariance.rows() == 6 || covariance.rows() == 6 + intrinsics);
  const Eigen::Matrix3d cam_from_world = posed.cam_from_world.rotation.toRotationMatrix();
  const Eigen::Vector3d point = cam_from_world * (world - Center(posed.cam_from_world));
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_lens(2, intrinsics);
  const auto pixel =
      camera.ProjectWith(camera.intrinsics().data(), point, &by_point, by_lens.data());
  if (!pixel || !camera.Sees(*pixel)) return std::nullopt;

  Eigen::MatrixXd jacobian(2, covariance.cols());
  for (int axis = 0; axis < 3; ++axis) {  // a left turn w moves the point by w cross p
    jacobian.col(axis) = by_point * Eigen::Vector3d::Unit(axis).cross(point);
  }
  jacobian.middleCols<3>(3) = -by_point * cam_from_world;
  if (covariance.cols() > 6) jacobian.rightCols(intrinsics) = by_lens;

  ImageUncertainty result;
  result.pixel = *pixel;
  const Eigen::MatrixXd with_pose = jacobian * covariance;
  result.covariance_px = with_pose * jacobian.transpose();
  if (uncertain != nullptr) {
    const Eigen::Matrix<double, 2, 3> by_world = by_point * cam_from_world;
    result.covariance_px += by_world * uncertain->covariance * by_world.transpose();
    if (uncertain->with_camera.size() > 0) {
      const Eigen::Matrix2d common = by_world * uncertain->with_camera * jacobian.transpose();
      result.covariance_px += common + common.transpose();
    }
  }
  const Eigen::Vector2d variances = EigenOfSymmetric(result.covariance_px).values.cwiseMax(0);
  result.minor_px = std::sqrt(variances[0]);
  result.major_px = std::sqrt(variances[1]);
  // by_point has no part along the line of sight, so its pseudo-inverse gives what is across it.
  const Eigen::Matrix<double, 3, 2> across_from_px =
      by_point.transpose() * (by_point * by_point.transpose()).inverse();
  const Eigen::Matrix3d across = across_from_px * result.covariance_px * across_from_px.transpose();
  result.major_m = std::sqrt(std::max(0.0, EigenOfSymmetric(across).values[2]));
  return result;
}

}  // namespace

std::optional<ImageUncertainty> ProjectWithUncertainty(const PosedCamera& posed,
                                                       const Eigen::MatrixXd& covariance,
                                                       const Eigen::Vector3d& world) {
  return ProjectBoth(posed, covariance, world, nullptr);
}

std::optional<ImageUncertainty> ProjectWithUncertainty(const PosedCamera& posed,
                                                       const Eigen::MatrixXd& covariance,
                                                       const Eigen::Vector3d& world,
                                                       const PointUncertainty& point) {
  return ProjectBoth(posed, covariance, world, &point);
}

}  // namespace insitu
