// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn lines that are surfaces: with thickness they are walls, with width ribbons, with both
// prisms. LINE, CIRCLE, ARC, LWPOLYLINE and flat POLYLINE alike.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace insitu {

struct DxfPathVertex {
  Eigen::Vector3d point;                  // in the entity's own axes; z is its elevation
  double bulge = 0;                       // tangent of a quarter of the angle to the next vertex
  double start_width = 0, end_width = 0;  // of the segment that begins here
};

struct DxfPath {
  int look = 0;          // of the block it is in
  Eigen::Matrix3d axes;  // block from entity
  std::vector<DxfPathVertex> vertices;
  bool closed = false;
  bool capped = false;   // a closed path without width has a bottom and a top (CIRCLE)
  double thickness = 0;  // along the entity's z

  bool IsSurface() const;  // has thickness or width
};

struct FacetedPath {
  std::vector<Eigen::Vector3d> vertices;  // in the block's coordinates
  std::vector<std::vector<int>> faces;    // corners; prisms' faces look outwards
};

// No chord is further from its arc than `tolerance` (of the path's own unit, > 0), and none spans
// over 15 degrees. Departure: at most 1024 chords a circle, however large.
FacetedPath Facet(const DxfPath& path, double tolerance);

}  // namespace insitu
