// SPDX-License-Identifier: GPL-3.0-or-later
// A site and a planned building cut into pieces, with the sun on them and what photographs show.
#pragma once

#include "radiometry/light/daylight.h"
#include "radiometry/transport/patches.h"

namespace insitu {

// Both sides of every polygon of `site`, whose triangles are `natural`, and of every face of
// `planned`, and the ground beyond its polygon if there is one. The sun's share and the
// photographed radiance are means over several points of a piece.
Patches MakePatches(const PhotographedSite& site, const TriangleMesh& natural,
                    const PlannedFaces& planned, const std::optional<GroundPlane>& ground,
                    const Daylight& light, const PatchGrid& grid);

}  // namespace insitu
