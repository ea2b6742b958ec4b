// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of architects' models cut into triangles.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace insitu {

// Of a face. Importers refuse more: time grows with their square.
constexpr size_t kMostCorners = 10000;

// Whether three points span no area: they lie on a line to 1e-9 of the longest side.
bool IsDegenerate(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// Triangles, wound like the face, of the face with the given `corners` (indices into `vertices`;
// equal neighbours count once). A quadrangle need not be planar: it is split along the diagonal
// that keeps both halves facing the same way, the shorter one if both do. Larger faces, convex or
// concave, are cut by their ears. Empty: no area, or a larger face whose outline crosses itself.
std::vector<Eigen::Vector3i> FaceTriangles(const std::vector<Eigen::Vector3d>& vertices,
                                           const std::vector<int>& corners);

}  // namespace insitu
