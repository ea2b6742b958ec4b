// SPDX-License-Identifier: GPL-3.0-or-later
// Light that the surroundings send to a surface: the photographs show how bright they are, and the
// polygons where they are. What the paper's ambient term stands for, measured instead of guessed.
#pragma once

#include <vector>

#include "radiometry/light/photographed_color.h"

namespace insitu {

// Irradiance at each point from all directions that do not end in the sky. A direction's radiance
// is the true colour of the polygon that it meets, by LookUpColor. What no photograph shows counts
// as the mean of all that was seen. Empty if none of the points sees any photographed surface.
std::vector<Spectrum> GatherSurroundings(const std::vector<SurfacePoint>& points,
                                         const PhotographedSite& site);

}  // namespace insitu
