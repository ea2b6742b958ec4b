// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/intersection.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"

namespace insitu {
namespace {

struct Line {
  Eigen::Vector3d origin;     // [m], world
  Eigen::Vector3d direction;  // unit, world
};

Line LineOfSight(const Sight& sight) {
  INSITU_CHECK(sight.camera != nullptr);
  const Rigid3& cam_from_world = sight.camera->cam_from_world;
  const Eigen::Vector3d direction_in_cam = sight.camera->camera.Unproject(sight.pixel);
  return {Center(cam_from_world), cam_from_world.rotation.conjugate() * direction_in_cam};
}

double LargestAngle(const std::vector<Line>& lines) {
  double largest = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t j = i + 1; j < lines.size(); ++j) {
      const Eigen::Vector3d &a = lines[i].direction, &b = lines[j].direction;
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      largest = std::max(largest, std::min(angle, M_PI - angle));
    }
  }
  return largest;
}

}  // namespace

std::optional<Eigen::Vector3d> Intersect(const std::vector<Sight>& sights, double min_angle) {
  std::vector<Line> lines;
  for (const Sight& sight : sights) lines.push_back(LineOfSight(sight));
  if (lines.size() < 2 || !(LargestAngle(lines) >= min_angle)) return std::nullopt;
  // Normal equations of the distances |P (x - o)|, P = I - d d^T, about the first centre.
  const Eigen::Vector3d origin = lines[0].origin;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Line& line : lines) {
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - line.direction * line.direction.transpose();
    normal += across;
    right += across * (line.origin - origin);
  }
  const Eigen::Vector3d point = origin + normal.inverse() * right;
  for (const Line& line : lines) {
    if (line.direction.dot(point - line.origin) <= 0) return std::nullopt;
  }
  return point;
}

std::optional<Eigen::Vector3d> IntersectPlane(const Sight& sight, const Eigen::Vector3d& normal,
                                              double offset) {
  const Line line = LineOfSight(sight);
  const double slope = normal.dot(line.direction);
  if (std::abs(slope) < 1e-12) return std::nullopt;
  const double distance = (offset - normal.dot(line.origin)) / slope;
  if (!(distance > 0)) return std::nullopt;
  return line.origin + distance * line.direction;
}

}  // namespace insitu
