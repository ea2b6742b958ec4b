// SPDX-License-Identifier: GPL-3.0-or-later
// The curves and surfaces of ACIS that have a closed form.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "renderer/acis/acis_file.h"

namespace insitu {

// Cones have elliptical sections; a cylinder is one of slope 0. Angles u about the z axis from x;
// v is along the axis [m], of spheres the latitude, of tori the angle about the tube.
struct AcisSurface {
  enum class Kind { kPlane, kCone, kSphere, kTorus };

  Kind kind = Kind::kPlane;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns x, y, z: unit; z: normal or axis
  double radius = 0;  // at the origin, along x; of the sphere; of the torus' middle circle; > 0
  double ratio = 1;   // of the section's radius along y
  double slope = 0;   // of the radius along the axis
  double tube = 0;    // radius of a torus' tube, > 0
  bool looks_inwards = false;  // its normal does

  Eigen::Vector3d PointAt(const Eigen::Vector2d& uv) const;
  Eigen::Vector2d ParametersOf(const Eigen::Vector3d& point) const;
  // Where the section has no extent: u is open.
  bool IsPole(const Eigen::Vector3d& point) const;
  // How far a point is off it.
  double DistanceTo(const Eigen::Vector3d& point) const;
};

// The angle that a chord of a circle may span: within `tolerance` of it, a 1024th to a 24th of it.
double ChordAngle(double radius, double tolerance);

// Axes of which z is farthest from all directions (unit): a sphere has none of its own.
Eigen::Matrix3d AxesAwayFrom(const std::vector<Eigen::Vector3d>& directions);

// nullopt: not of the four kinds, or none that has a surface.
std::optional<AcisSurface> AcisSurfaceOf(const AcisRecord& record);

struct AcisEllipse {
  Eigen::Vector3d center, x, y;  // half axes; it runs from x to y

  Eigen::Vector3d PointAt(double angle) const;
  double AngleOf(const Eigen::Vector3d& point) const;
};
std::optional<AcisEllipse> AcisEllipseOf(const AcisRecord& record);

std::optional<Eigen::Vector3d> AcisPointOf(const AcisRecord& record);

// Of a body; nullopt: damaged.
std::optional<Eigen::Affine3d> AcisTransformOf(const AcisRecord& record);

// Whether "reversed" stands behind token `index`, by word, flag or number; the first word or flag
// there tells.
bool IsAcisReversed(const AcisRecord& record, size_t index);

}  // namespace insitu
