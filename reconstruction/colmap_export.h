// SPDX-License-Identifier: GPL-3.0-or-later
// Our networks and results as COLMAP models, so that anyone can check them with COLMAP.
#pragma once

#include "reconstruction/adjustment/adjusted_survey.h"
#include "reconstruction/colmap/colmap_model.h"
#include "reconstruction/network/network.h"

namespace insitu {

struct ColmapLensFit {
  ColmapLens lens;
  double largest_px = 0;  // between both over the photograph; 0: the same lens exactly
};

// The lens in COLMAP's terms: exactly where COLMAP has it (PINHOLE, OPENCV, FULL_OPENCV), else the
// first of OPENCV, FULL_OPENCV with one and with four radial parameters more that comes within 0.01
// px over the photograph, or the nearest of them. Metric cameras and splined lenses are fitted.
ColmapLensFit FitColmapLens(const Lens& lens);

// Cameras, photos, points and marks of a network, world coordinates; what else it observes COLMAP
// does not know. Images bear the photos' names without ending; cameras, images and points have the
// ids index + 1. A point marked on fewer than two photos has only its keypoints.
ColmapModel ColmapFromNetwork(const Network& network);

// The same of an adjustment's result.
ColmapModel ColmapFromAdjustment(const Adjustment& adjustment);

}  // namespace insitu
