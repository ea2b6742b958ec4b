// SPDX-License-Identifier: GPL-3.0-or-later
// The campus: lawn, gravel path, gallery, house, two blocks and a clear morning.
#pragma once

#include "datasets_synthetic/made_site.h"

namespace insitu::demo {

// `width`, `height` [px]: size of the photographs. `azimuth` [rad] of the plan's x axis: from it
// follows where on the plan the sun stands.
Site MakeCampus(int width, int height, double azimuth = 145 * kDegree);

}  // namespace insitu::demo
