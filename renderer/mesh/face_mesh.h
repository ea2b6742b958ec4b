// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of polygons, smoothed by subdivision.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

namespace insitu {

struct FaceMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;            // corners, at least three
  std::map<std::pair<int, int>, double> creases;  // edge (smaller vertex first) -> levels kept
};

constexpr int kFinestSmoothing = 4;

// One step of Catmull and Clark's subdivision (1978); open edges and edges with a crease stay sharp
// (DeRose et al. 1998), a crease loses one level.
FaceMesh Smoothed(const FaceMesh& mesh);

}  // namespace insitu
