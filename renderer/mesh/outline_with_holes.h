// SPDX-License-Identifier: GPL-3.0-or-later
// Faces with holes as one outline, which FaceTriangles cuts.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// The outline with every hole joined to it by a double edge that crosses nothing; all are indices
// into `vertices`, wound either way. A hole of fewer than three corners, or that no edge reaches
// since it crosses the outline, is left out and counted in `*lost`.
std::vector<int> OutlineWithHoles(const std::vector<Eigen::Vector3d>& vertices,
                                  const std::vector<int>& outline,
                                  const std::vector<std::vector<int>>& holes, int* lost);

}  // namespace insitu
