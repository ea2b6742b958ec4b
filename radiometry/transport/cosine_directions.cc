// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/cosine_directions.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace insitu {

std::vector<Eigen::Vector3d> CosineDirections(const Eigen::Vector3d& normal, int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double squared = (i + 0.5) / count;  // of the radius
    const double radius = std::sqrt(squared);
    const double angle = i * golden_angle;
    directions.push_back(radius * (std::cos(angle) * u + std::sin(angle) * v) +
                         std::sqrt(1 - squared) * normal);
  }
  return directions;
}

}  // namespace insitu
