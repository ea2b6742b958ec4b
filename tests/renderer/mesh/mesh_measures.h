// SPDX-License-Identifier: GPL-3.0-or-later
// Area and volume of meshes, for tests with closed forms.
#pragma once

#include <Eigen/Geometry>

#include "renderer/mesh/model.h"

namespace insitu {

inline double AreaOf(const ModelMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
  }
  return area;
}

// By Gauss's theorem; positive if the faces of a closed body are wound counter-clockwise outside.
inline double VolumeOf(const ModelMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  }
  return volume;
}

}  // namespace insitu
