// SPDX-License-Identifier: GPL-3.0-or-later
// Directions over a hemisphere, as dense as the cosine.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// `count` unit directions about a unit normal, each of which stands for pi / count of irradiance per
// radiance. A Fibonacci lattice on the disc, lifted to the hemisphere (Malley): no two lie in one
// plane with the normal, so that an edge crosses them one by one and leaves no bands.
std::vector<Eigen::Vector3d> CosineDirections(const Eigen::Vector3d& normal, int count);

}  // namespace insitu
