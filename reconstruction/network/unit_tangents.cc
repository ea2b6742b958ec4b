// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/unit_tangents.h"

#include <ceres/sphere_manifold.h>

namespace insitu {

Eigen::Matrix<double, 3, 2> TangentsOf(const Eigen::Vector3d& unit) {
  Eigen::Matrix<double, 3, 2, Eigen::RowMajor> unit_from_tangent;  // Ceres' order
  ceres::SphereManifold<3>().PlusJacobian(unit.data(), unit_from_tangent.data());
  return unit_from_tangent;
}

}  // namespace insitu
