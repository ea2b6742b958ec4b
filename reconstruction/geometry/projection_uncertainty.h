// SPDX-License-Identifier: GPL-3.0-or-later
// What the adjustment means for the montage: how well the image of any point of space is known.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calibration/lens/camera.h"

namespace insitu {

// Semi-axes of the ellipse that holds 95 % of a plane error, over those of the standard ellipse.
inline constexpr double kEllipse95 = 2.4477;  // sqrt(-2 ln 0.05)

struct ImageUncertainty {
  Eigen::Vector2d pixel;              // of the photograph
  Eigen::Matrix2d covariance_px;      // [px^2]
  double major_px = 0, minor_px = 0;  // semi-axes of the standard ellipse [px]
  double major_m = 0;  // the same displacement across the line of sight at the point [m]
};

// The image of a point that is itself exactly known, such as a planned building's corner.
// `covariance`: of the photo's left rotation increment [rad], centre [m] and, where its lens is
// uncertain, all intrinsics in their order: 6 x 6 or (6 + n) x (6 + n).
// nullopt: the point is not before the camera, or outside its photograph.
std::optional<ImageUncertainty> ProjectWithUncertainty(const PosedCamera& camera,
                                                       const Eigen::MatrixXd& covariance,
                                                       const Eigen::Vector3d& world);

// What is known of a point that was adjusted together with the camera.
struct PointUncertainty {
  Eigen::Matrix3d covariance;   // [m^2]
  Eigen::MatrixXd with_camera;  // 3 x n, against the camera's `covariance`; empty: independent
};

// The same of a point that is itself not exactly known: J_p C_p J_p^T + J_c C_c J_c^T and what both
// have in common.
std::optional<ImageUncertainty> ProjectWithUncertainty(const PosedCamera& camera,
                                                       const Eigen::MatrixXd& covariance,
                                                       const Eigen::Vector3d& world,
                                                       const PointUncertainty& point);

}  // namespace insitu
