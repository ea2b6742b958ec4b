// SPDX-License-Identifier: GPL-3.0-or-later
// A face on a cone, a sphere or a torus cut into triangles.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "renderer/acis/acis_geometry.h"

namespace insitu {

struct CurvedFace {
  AcisSurface surface;
  bool looks_inwards = false;           // the face, not its surface
  std::vector<std::vector<int>> rings;  // vertices of its loops, the face on their left
};

// Adds its triangles, and vertices within it and along a cut that opens it. Empty: done; else why
// the face is left out.
std::string AddCurvedFace(const CurvedFace& face, double tolerance,
                          std::vector<Eigen::Vector3d>* vertices,
                          std::vector<Eigen::Vector3i>* triangles);

}  // namespace insitu
