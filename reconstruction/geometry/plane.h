// SPDX-License-Identifier: GPL-3.0-or-later
// Planes and outlines in space: best fit, orientation, projection along the dominant axis.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

// The points x with normal . (x - point) = 0.
struct Plane {
  Eigen::Vector3d normal;  // unit
  Eigen::Vector3d point;   // [m]

  double SignedDistance(const Eigen::Vector3d& x) const { return normal.dot(x - point); }
};

// Unit normal of an outline, counter-clockwise seen from its tip (Newell's method, about the first
// vertex); zero for an outline without area.
Eigen::Vector3d OutlineNormal(const std::vector<Eigen::Vector3d>& vertices);

// Within an outline that does not cross itself [m^2].
double AreaOf(const std::vector<Eigen::Vector3d>& vertices);

// Least-squares plane through at least three points, its point their centroid, its sign arbitrary.
Plane FitPlane(const std::vector<Eigen::Vector3d>& points);

// The outline along the dominant axis of `normal`, relative to `origin`; counter-clockwise about
// `normal` stays counter-clockwise.
std::vector<Eigen::Vector2d> ProjectOutline(const std::vector<Eigen::Vector3d>& vertices,
                                            const Eigen::Vector3d& normal,
                                            const Eigen::Vector3d& origin);

// Whether a point lies inside a closed outline, by the parity of crossings; in an empty one nothing
// does.
bool IsInside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point);

}  // namespace insitu
