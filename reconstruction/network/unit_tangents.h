// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace insitu {

// d unit / d tangent: the two columns that the adjustment's unknowns of a unit vector stand for, as
// ceres::SphereManifold lays them.
Eigen::Matrix<double, 3, 2> TangentsOf(const Eigen::Vector3d& unit);

}  // namespace insitu
