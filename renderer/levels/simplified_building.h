// SPDX-License-Identifier: GPL-3.0-or-later
// A building of many small faces as a quick look needs it: what hides less than a few pixels is
// taken together.
#pragma once

#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// How much of the building so many pixels in the middle of the sharpest photograph may hide, from
// the nearest of all cameras [m]; 0: one stands within the building's box.
double OcclusionSize(const NaturalEnvironment& natural, const ArtificialEnvironment& building,
                     double pixels);

// The same with the corners of opaque faces without textures moved together, those of a cell of
// about `size` [m] into one, and the faces that this leaves without area gone. Of fewer than
// kFewTriangles, with size 0, or over a thousand cells long, nothing changes.
inline constexpr size_t kFewTriangles = 50'000;
ArtificialEnvironment Simplified(const ArtificialEnvironment& building, double size);

}  // namespace insitu
