// SPDX-License-Identifier: GPL-3.0-or-later
// Intersection in space: a point from its marks on posed photographs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

struct Sight {
  const PosedCamera* camera = nullptr;  // never null
  Eigen::Vector2d pixel;
};

// Second inversion of the camera model. [Durisch92, §4.1]
// Least squares over the perpendicular distances to the rays. nullopt: fewer than two rays, rays
// nearly parallel (largest angle below `min_angle` [rad]), or a point behind a camera.
std::optional<Eigen::Vector3d> Intersect(const std::vector<Sight>& sights, double min_angle = 1e-3);

// The point where a sight meets a plane n.x = d. nullopt: parallel or behind.
std::optional<Eigen::Vector3d> IntersectPlane(const Sight& sight, const Eigen::Vector3d& normal,
                                              double offset);

}  // namespace insitu
