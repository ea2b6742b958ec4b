// SPDX-License-Identifier: GPL-3.0-or-later
// A region of a surface's parameters cut into triangles that no chord leaves far: constrained
// Delaunay, since what is near in parameters is near on the surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace insitu {

class UvMesh {
 public:
  // `outline` counter-clockwise, as OutlineWithHoles gives it: indices into `points`, which may
  // come twice along a double edge. Its edges stay. Without triangles: it crosses itself.
  UvMesh(std::vector<Eigen::Vector2d> points, const std::vector<int>& outline);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  const std::vector<Eigen::Vector3i>& triangles() const { return triangles_; }

  // Adds a point within the region; one on its rim, or without, is left out.
  void Insert(const Eigen::Vector2d& point);

 private:
  int Find(int from, int to) const;  // the triangle on the left of an edge; -1: the boundary
  void Set(int triangle, const Eigen::Vector3i& corners);
  int Locate(const Eigen::Vector2d& point) const;
  void SplitEdge(int a, int b, const Eigen::Vector2d& point);
  void Legalize(std::vector<std::pair<int, int>> edges);

  std::vector<Eigen::Vector2d> points_;
  std::vector<Eigen::Vector3i> triangles_;
  std::unordered_map<uint64_t, int> triangle_of_edge_;
  int last_ = 0;
};

}  // namespace insitu
