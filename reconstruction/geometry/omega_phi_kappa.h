// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation angles as photogrammetric programs state them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace insitu {

inline constexpr double kDegree = std::numbers::pi / 180;  // [rad]

// omega about x, then phi about the turned y, then kappa about the turned z [rad] lead from the
// world's axes to those of a camera that looks along its -z, x right, y up: R = Rx Ry Rz
// (AICON, DBAT, PhotoModeler, Metashape). The result is of our axes: y down, z forward.
Eigen::Quaterniond CamFromWorldOmegaPhiKappa(const Eigen::Vector3d& angles);

// Its inverse; phi in [-pi/2, pi/2], at its ends kappa = 0.
Eigen::Vector3d OmegaPhiKappa(const Eigen::Quaterniond& cam_from_world);

}  // namespace insitu
