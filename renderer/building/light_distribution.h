// SPDX-License-Identifier: GPL-3.0-or-later
// How a lamp's intensity depends on the direction.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// Relative intensity by direction, as in an IES file: gamma is the angle to the lamp's axis, C the
// angle about it. Linear between the angles given; over C it goes round if it covers a full turn,
// is mirrored if it covers 90 or 180 degrees, and does not matter if there is one.
struct LightDistribution {
  Eigen::Matrix3d world_from_lamp;  // columns: C = 0, C = 90, the axis (gamma = 0)
  std::vector<double> gamma_deg;    // rising
  std::vector<double> c_deg;        // rising
  std::vector<double> values;       // >= 0, all gammas of the first C, then of the next

  double At(const Eigen::Vector3d& direction) const;  // unit vector, from the lamp, world
};

}  // namespace insitu
