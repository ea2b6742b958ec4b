// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/uv_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "reconstruction/geometry/triangulate.h"

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3i;

uint64_t EdgeKey(int from, int to) {
  return static_cast<uint64_t>(static_cast<uint32_t>(from)) << 32 | static_cast<uint32_t>(to);
}

// Twice the area of a triangle, positive if it turns left.
double TurnOf(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Whether d lies within the circle about a, b and c, which turn left.
bool IsWithinCircle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  Eigen::Matrix3d m;
  int row = 0;
  for (const Vector2d& p : {a, b, c}) {
    m.row(row++) << (p - d).x(), (p - d).y(), (p - d).squaredNorm();
  }
  constexpr double kRounding = 1e-12;
  return m.determinant() > kRounding * m.col(2).maxCoeff() * m.col(2).maxCoeff();
}

int Opposite(const Vector3i& corners, int from, int to) {
  for (const int corner : corners) {
    if (corner != from && corner != to) return corner;
  }
  return corners[0];
}

}  // namespace

UvMesh::UvMesh(std::vector<Vector2d> points, const std::vector<int>& outline)
    : points_(std::move(points)) {
  std::vector<Eigen::Vector3d> flat;
  for (const int corner : outline) {
    flat.emplace_back(points_[corner].x(), points_[corner].y(), 0);
  }
  const auto ears = Triangulate(flat, Eigen::Vector3d::UnitZ());
  if (!ears) return;
  std::vector<std::pair<int, int>> edges;
  for (const Vector3i& ear : *ears) {
    triangles_.emplace_back();
    Set(static_cast<int>(triangles_.size()) - 1,
        {outline[ear[0]], outline[ear[1]], outline[ear[2]]});
    const Vector3i& corners = triangles_.back();
    for (int i = 0; i < 3; ++i) edges.emplace_back(corners[i], corners[(i + 1) % 3]);
  }
  Legalize(std::move(edges));
}

int UvMesh::Find(int from, int to) const {
  const auto found = triangle_of_edge_.find(EdgeKey(from, to));
  return found == triangle_of_edge_.end() ? -1 : found->second;
}

void UvMesh::Set(int triangle, const Vector3i& corners) {
  triangles_[triangle] = corners;
  for (int i = 0; i < 3; ++i) {
    triangle_of_edge_[EdgeKey(corners[i], corners[(i + 1) % 3])] = triangle;
  }
}

// Walks towards the point; over a boundary the region is searched through.
int UvMesh::Locate(const Vector2d& point) const {
  const auto outer_edge = [&](int t) {
    for (int i = 0; i < 3; ++i) {
      const int a = triangles_[t][i], b = triangles_[t][(i + 1) % 3];
      if (TurnOf(points_[a], points_[b], point) < 0) return i;
    }
    return -1;
  };
  int t = last_;
  for (size_t steps = 0; steps < triangles_.size(); ++steps) {
    const int edge = outer_edge(t);
    if (edge < 0) return t;
    t = Find(triangles_[t][(edge + 1) % 3], triangles_[t][edge]);
    if (t < 0) break;
  }
  for (t = 0; t < std::ssize(triangles_); ++t) {
    if (outer_edge(t) < 0) return t;
  }
  return -1;
}

void UvMesh::Insert(const Vector2d& point) {
  const int t = triangles_.empty() ? -1 : Locate(point);
  if (t < 0) return;
  const Vector3i corners = triangles_[t];
  const double area = TurnOf(points_[corners[0]], points_[corners[1]], points_[corners[2]]);
  for (int i = 0; i < 3; ++i) {
    const int a = corners[i], b = corners[(i + 1) % 3];
    if (TurnOf(points_[a], points_[b], point) <= 1e-9 * area) return SplitEdge(a, b, point);
  }
  const int added = static_cast<int>(points_.size());
  points_.push_back(point);
  const int next = static_cast<int>(triangles_.size());
  triangles_.resize(triangles_.size() + 2);
  Set(t, {corners[0], corners[1], added});
  Set(next, {corners[1], corners[2], added});
  Set(next + 1, {corners[2], corners[0], added});
  last_ = t;
  Legalize({{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}});
}

// Of two triangles, that become four; those of the region's rim stay whole.
void UvMesh::SplitEdge(int a, int b, const Vector2d& point) {
  const int left = Find(a, b), right = Find(b, a);
  if (left < 0 || right < 0) return;
  const int c = Opposite(triangles_[left], a, b), d = Opposite(triangles_[right], b, a);
  for (const auto& [from, to] : {std::pair(b, c), {c, a}, {a, d}, {d, b}}) {
    if (TurnOf(points_[from], points_[to], point) <= 0) return;
  }
  const int added = static_cast<int>(points_.size());
  points_.push_back(point);
  triangle_of_edge_.erase(EdgeKey(a, b));
  triangle_of_edge_.erase(EdgeKey(b, a));
  const int next = static_cast<int>(triangles_.size());
  triangles_.resize(triangles_.size() + 2);
  Set(left, {c, a, added});
  Set(right, {d, b, added});
  Set(next, {b, c, added});
  Set(next + 1, {a, d, added});
  last_ = left;
  Legalize({{b, c}, {c, a}, {a, d}, {d, b}});
}

// Turns edges between two triangles as long as one's circle holds the other's corner. [Lawson 1977]
void UvMesh::Legalize(std::vector<std::pair<int, int>> edges) {
  const size_t most = 64 + 16 * triangles_.size() * 8;  // rounding must not turn one for ever
  for (size_t turns = 0; !edges.empty() && turns < most;) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    const int left = Find(a, b), right = Find(b, a);
    if (left < 0 || right < 0) continue;
    const int c = Opposite(triangles_[left], a, b), d = Opposite(triangles_[right], b, a);
    const bool is_convex = TurnOf(points_[d], points_[b], points_[c]) > 0 &&
                           TurnOf(points_[c], points_[a], points_[d]) > 0;
    if (!is_convex || !IsWithinCircle(points_[a], points_[b], points_[c], points_[d])) continue;
    ++turns;
    triangle_of_edge_.erase(EdgeKey(a, b));
    triangle_of_edge_.erase(EdgeKey(b, a));
    Set(left, {d, b, c});
    Set(right, {c, a, d});
    for (const auto& edge : {std::pair(b, c), {c, a}, {a, d}, {d, b}}) edges.push_back(edge);
  }
}

}  // namespace insitu
