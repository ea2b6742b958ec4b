// SPDX-License-Identifier: GPL-3.0-or-later
// Ear clipping of a polygon's outline.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace insitu {

// Triangles (indices into `vertices`) of a simple planar polygon, convex or concave, by ear
// clipping about `normal`; nullopt if the outline crosses itself or has no area.
std::optional<std::vector<Eigen::Vector3i>> Triangulate(
    const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal);

}  // namespace insitu
