// SPDX-License-Identifier: GPL-3.0-or-later
// What of a building makes its image: the edges of its outline from a place, and its sharp corners.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "renderer/building/artificial_environment.h"

namespace insitu {

using EdgeEnds = std::pair<int, int>;                             // indices of points
using OutlineEdge = std::pair<Eigen::Vector3d, Eigen::Vector3d>;  // its ends [m], world

// The circle in which lines of sight from `eye` touch a sphere, as a polygon of `corners` points of
// it; empty: the eye is within the sphere. [m], world
std::vector<Eigen::Vector3d> SilhouetteFrom(const Eigen::Vector3d& eye,
                                            const EnvironmentSphere& sphere, int corners);

// Its sides: within 0.3 per mille of the radius.
std::vector<OutlineEdge> SilhouetteEdges(const Eigen::Vector3d& eye,
                                         const EnvironmentSphere& sphere);

class BuildingEdges {
 public:
  // Vertices nearer than a millimetre are one.
  explicit BuildingEdges(const ArtificialEnvironment& building);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }  // [m], world

  // Edges beside which one face is seen from `eye` [m] and one is not, and open ones; hidden ones
  // too. Of spheres their silhouettes.
  std::vector<OutlineEdge> OutlineFrom(const Eigen::Vector3d& eye) const;

  // Ends of the outline's edges, and wherever edges of over 30 degrees end, meet or bend, in the
  // mesh's order; then sixteen points about each sphere. [m]
  std::vector<Eigen::Vector3d> CornersSeenFrom(const Eigen::Vector3d& eye) const;

 private:
  struct Edge {
    EdgeEnds ends;
    std::vector<Eigen::Vector3d> normals;  // of the faces beside it, all to the same side of it
  };
  void AddFaces(const ArtificialEnvironment& building, const std::vector<int>& point_of_vertex);
  void FindSharpCorners();
  std::vector<EdgeEnds> MeshOutlineFrom(const Eigen::Vector3d& eye) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<Edge> edges_;
  std::vector<char> is_sharp_;  // of a point
  std::vector<EnvironmentSphere> spheres_;
};

}  // namespace insitu
