// SPDX-License-Identifier: GPL-3.0-or-later
// Directions over a hemisphere, as dense as the cosine.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// Unit directions about a unit normal, each of which stands for pi / count of irradiance per
// radiance. A Fibonacci lattice on the disc, lifted to the hemisphere (Malley): no two lie in one
// plane with the normal, so that an edge crosses them one by one and leaves no bands. Ordered so
// that any 16 in a row, from the first on, lie close together.
class CosineDirections {
 public:
  explicit CosineDirections(int count);  // > 0

  int count() const { return static_cast<int>(about_z_.size()); }
  std::vector<Eigen::Vector3d> About(const Eigen::Vector3d& normal) const;

 private:
  std::vector<Eigen::Vector3d> about_z_;
};

}  // namespace insitu
