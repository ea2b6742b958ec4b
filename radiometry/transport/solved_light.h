// SPDX-License-Identifier: GPL-3.0-or-later
// Light among the pieces of a scene once it is solved: all that gathering it at a point needs.
#pragma once

#include <vector>

#include "radiometry/light/photographed_color.h"
#include "radiometry/spectrum/spectrum.h"

namespace insitu {

struct SolvedPiece {
  SurfacePoint point;
  int polygon = -1;  // of the site; -1: planned faces
  bool is_beyond = false, is_seen = false;
  Spectrum before = Spectrum::Zero(), change = Spectrum::Zero();  // radiance, of a natural piece
  Spectrum irradiance = Spectrum::Zero();                         // of a planned one
};

struct SolvedLight {
  Spectrum sky = Spectrum::Zero(), beyond = Spectrum::Zero();  // radiances
  std::vector<Spectrum> brdf_of_polygon;                       // [1/sr]
  std::vector<SolvedPiece> pieces;
};

}  // namespace insitu
