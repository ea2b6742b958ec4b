// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/omega_phi_kappa.h"

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

// Half a turn about x: between a camera that looks along -z, y up, and ours.
const Eigen::Quaterniond kHalfTurn(0, 1, 0, 0);

}  // namespace

Eigen::Quaterniond CamFromWorldOmegaPhiKappa(const Eigen::Vector3d& angles) {
  const Eigen::Quaterniond world_from_camera =
      Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()) *
      Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ());
  return (kHalfTurn * world_from_camera.conjugate()).normalized();
}

Eigen::Vector3d OmegaPhiKappa(const Eigen::Quaterniond& cam_from_world) {
  const Eigen::Matrix3d r = (kHalfTurn.conjugate() * cam_from_world).conjugate().matrix();
  const double phi = std::asin(std::clamp(r(0, 2), -1.0, 1.0));
  if (std::hypot(r(0, 0), r(0, 1)) < 1e-12) return {std::atan2(r(2, 1), r(1, 1)), phi, 0};
  return {std::atan2(-r(1, 2), r(2, 2)), phi, std::atan2(-r(0, 1), r(0, 0))};
}

}  // namespace insitu
