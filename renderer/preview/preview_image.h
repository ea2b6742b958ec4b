// SPDX-License-Identifier: GPL-3.0-or-later
// A quick picture of the building, before any photograph is rendered.
#pragma once

#include "calibration/photo/raster.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// Parallel projection from the south-west and 30 degrees above, z up, filling the picture; facets
// shaded by their direction, edges drawn where depth or direction jumps. Linear Rec. 709.
Raster PreviewImage(const ArtificialEnvironment& building, int width = 1200, int height = 900);

}  // namespace insitu
