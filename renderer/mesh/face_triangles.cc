// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/face_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "reconstruction/geometry/triangulate.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

Vector3d Cross(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (b - a).cross(c - a);
}

std::vector<Vector3d> WithoutRepeats(const std::vector<Vector3d>& vertices,
                                     const std::vector<int>& corners, std::vector<int>* kept) {
  std::vector<Vector3d> points;
  for (const int corner : corners) {
    if (!points.empty() && points.back() == vertices[corner]) continue;
    points.push_back(vertices[corner]);
    kept->push_back(corner);
  }
  while (points.size() > 1 && points.front() == points.back()) {
    points.pop_back();
    kept->pop_back();
  }
  return points;
}

std::vector<Vector3i> QuadrangleTriangles(const std::vector<Vector3d>& p) {
  const bool first_agrees = Cross(p[0], p[1], p[2]).dot(Cross(p[0], p[2], p[3])) > 0;
  const bool second_agrees = Cross(p[1], p[2], p[3]).dot(Cross(p[1], p[3], p[0])) > 0;
  // Rounding does not decide between equal diagonals: the same drawing saved in binary is split
  // alike.
  constexpr double kTie = 1 + 1e-9;
  const bool first_shorter = (p[2] - p[0]).squaredNorm() <= kTie * (p[3] - p[1]).squaredNorm();
  if (first_agrees == second_agrees ? first_shorter : first_agrees) return {{0, 1, 2}, {0, 2, 3}};
  return {{1, 2, 3}, {1, 3, 0}};
}

// Area vector by Newell's sum, about the first corner so that large coordinates lose nothing.
std::vector<Vector3i> EarTriangles(const std::vector<Vector3d>& p) {
  Vector3d area = Vector3d::Zero();
  double longest = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i) {
    area += Cross(p[0], p[i], p[i + 1]);
    longest = std::max(longest, (p[i] - p[0]).norm());
  }
  if (area.norm() <= 1e-9 * longest * longest) return {};
  return Triangulate(p, area.normalized()).value_or(std::vector<Vector3i>{});
}

std::vector<Vector3i> TrianglesOf(const std::vector<Vector3d>& points) {
  if (points.size() < 3) return {};
  if (points.size() == 3) return {{0, 1, 2}};
  return points.size() == 4 ? QuadrangleTriangles(points) : EarTriangles(points);
}

}  // namespace

bool IsDegenerate(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const std::array sides = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
  return Cross(a, b, c).norm() <= 1e-9 * std::ranges::max(sides);
}

std::vector<Vector3i> FaceTriangles(const std::vector<Vector3d>& vertices,
                                    const std::vector<int>& corners) {
  std::vector<int> kept;
  const std::vector<Vector3d> points = WithoutRepeats(vertices, corners, &kept);
  std::vector<Vector3i> triangles;
  for (const Vector3i& t : TrianglesOf(points)) {
    if (IsDegenerate(points[t[0]], points[t[1]], points[t[2]])) continue;
    triangles.emplace_back(kept[t[0]], kept[t[1]], kept[t[2]]);
  }
  return triangles;
}

}  // namespace insitu
