// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of ACIS bodies as triangles.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "renderer/acis/acis_file.h"

namespace insitu {

struct AcisSphere {
  Eigen::Vector3d center;
  double radius = 0;  // > 0
};

// In the drawing's units, body transforms applied.
struct AcisShape {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  // counter-clockwise seen from where their face looks
  std::vector<AcisSphere> spheres;         // whole ones: exact
  int faces = 0;                           // that the file holds
  std::map<std::string, int> unread;       // why -> faces that are left out
};

// Planes, cylinders, cones, spheres and tori, bounded by straight lines, ellipses and splines; both
// faces at an edge share its points. No chord is further from its curve or surface than `tolerance`
// (> 0), and none spans over 15 degrees; at most 1024 chords go to a circle. What is bounded
// otherwise or lies on another surface is counted as unread, and so is what comes after about
// `most_vertices`.
AcisShape FacetedAcis(const AcisFile& file, double tolerance, double most_vertices = 2e7);

}  // namespace insitu
