// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sensor clipped: a reflectance found there is a lower bound.
#pragma once

#include <vector>

#include "radiometry/measure/photograph_set.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct ClippedShare {
  int photo = 0, polygon = 0;  // indices into the scene's
  double share = 0;            // of the polygon's pixels in the photograph, 0..1
};

// Of every polygon in every photograph that shows it, the largest first; those without any clipped
// pixel are left out. Looks at a grid of about 40,000 pixels a photograph.
std::vector<ClippedShare> MeasureClippedShares(const SceneGeometry& scene,
                                               const PhotographSet& photos);

}  // namespace insitu
