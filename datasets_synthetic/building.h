// SPDX-License-Identifier: GPL-3.0-or-later
// A planned building as it is drawn: panels, a block that is inserted many times, and round bodies.
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
  bool is_ring = false;  // the first row follows the last
};

// The drawing, in site coordinates but for the window block.
struct Building {
  std::vector<Material> layers;
  std::vector<Panel> panels;
  std::vector<Panel> window;  // x along the wall, y out of it, z up
  std::vector<Placement> windows;
  std::vector<Polyhedron> bodies;
  std::vector<RoundMesh> meshes;
};

// The quad a, b, c, d, counter-clockwise from outside.
Panel Quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
           const Eigen::Vector3d& d, Material material);

void AddBox(std::vector<Panel>& panels, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
            Material material);

// A pane 3 cm before the wall in a frame 10 cm deep, with one transom.
std::vector<Panel> WindowBlock(double width, double height);

// A faceted ball: an octahedron refined `levels` times to 8 * 4^levels triangles.
Polyhedron Ball(const Eigen::Vector3d& center, double radius, int levels, Material material);

// A cone on `foot` of `rows` rings, 3 cm thick at its tip.
RoundMesh Cone(const Eigen::Vector3d& foot, double height, double radius, int rows, int columns,
               Material material);

// A ring that lies level: `radius` to the middle of a tube of radius `tube`.
RoundMesh Torus(const Eigen::Vector3d& center, double radius, double tube, Material material);

// `building`, drawn on plan, with its x axis at `azimuth` [rad] about z: upright in the survey's
// frame, as drawn by someone who does not know that its z is not quite the zenith.
Building Turned(Building building, double azimuth);

Scene BuildingScene(const Building& building);

}  // namespace insitu::demo
