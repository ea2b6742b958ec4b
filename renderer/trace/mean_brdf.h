// SPDX-License-Identifier: GPL-3.0-or-later
// What natural surfaces reflect where no photograph shows them.
#pragma once

#include <vector>

#include "renderer/trace/montage_scene.h"

namespace insitu {

// For each polygon the mean of rho, [Durisch92, Eq. (10)], over all photographed polygons of its
// material, or of the whole site where its material is nowhere photographed.
std::vector<Spectrum> MeanBrdfOfPolygons(const MontageScene& scene);

}  // namespace insitu
