// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/plane.h"

#include <Eigen/Geometry>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"

namespace insitu {

Eigen::Vector3d OutlineNormal(const std::vector<Eigen::Vector3d>& vertices) {
  INSITU_CHECK(vertices.size() >= 3);
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice_area += (vertices[i] - vertices[0]).cross(vertices[i + 1] - vertices[0]);
  }
  return twice_area.stableNormalized();
}

double AreaOf(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice_area += (vertices[i] - vertices[0]).cross(vertices[i + 1] - vertices[0]);
  }
  return twice_area.norm() / 2;
}

Plane FitPlane(const std::vector<Eigen::Vector3d>& points) {
  INSITU_CHECK(points.size() >= 3);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point - points[0];
  mean = mean / static_cast<double>(points.size()) + points[0];
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points)
    scatter += (point - mean) * (point - mean).transpose();
  return {EigenOfSymmetric(scatter).vectors.col(0).normalized(), mean};
}

std::vector<Eigen::Vector2d> ProjectOutline(const std::vector<Eigen::Vector3d>& vertices,
                                            const Eigen::Vector3d& normal,
                                            const Eigen::Vector3d& origin) {
  int dominant = 0;
  normal.cwiseAbs().maxCoeff(&dominant);
  int first = (dominant + 1) % 3, second = (dominant + 2) % 3;
  if (normal[dominant] < 0) std::swap(first, second);
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) {
    const Eigen::Vector3d local = vertex - origin;
    outline.emplace_back(local[first], local[second]);
  }
  return outline;
}

bool IsInside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point) {
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Eigen::Vector2d &a = outline[i], &b = outline[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double crossing = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < crossing) inside = !inside;
  }
  return inside;
}

}  // namespace insitu
