// SPDX-License-Identifier: GPL-3.0-or-later
// Both environments made ready for rays.
#pragma once

#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/photo/raster.h"
#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// `artificial` may be empty: the site as it is. `images` are the input images, in the order of
// natural.scene.cameras, as are the pinhole cameras that see them.
MontageScene MakeMontageScene(NaturalEnvironment natural, const ArtificialEnvironment& artificial,
                              const std::vector<Camera>& pinholes, std::vector<Raster> images);

}  // namespace insitu
