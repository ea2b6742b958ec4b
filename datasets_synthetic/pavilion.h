// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building: a pavilion with glass windows, a tapered mast and a stone ball.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets_synthetic/scene.h"

namespace insitu::demo {

// Three or four corners; a drawing's 3DFACE.
struct Panel {
  std::vector<Eigen::Vector3d> corners;
  Material material;
};

// Where a copy of the window block stands: block coordinates turned about z, then moved.
struct Placement {
  Eigen::Vector3d position;
  double turn = 0;  // [rad]
};

struct Polyhedron {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  Material material;
};

// rows x columns vertices, row-major, closed round each row.
struct RoundMesh {
  int rows = 0, columns = 0;
  std::vector<Eigen::Vector3d> vertices;
  Material material;
};

// The drawing, in site coordinates but for the window block.
struct Pavilion {
  std::vector<Panel> panels;
  std::vector<Panel> window;  // x along the wall, y out of it, z up
  std::vector<Placement> windows;
  Polyhedron ball;
  RoundMesh mast;
};

// `azimuth` [rad]: of the building's x axis about z. Upright in the survey's frame, as drawn by
// someone who does not know that its z is not quite the zenith; the base reaches into the ground.
Pavilion MakePavilion(double azimuth);

Scene PavilionScene(const Pavilion& pavilion);

}  // namespace insitu::demo
