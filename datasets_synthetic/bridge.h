// SPDX-License-Identifier: GPL-3.0-or-later
// Example 2: a covered timber bridge on the supports of one that burnt, over rippled water.
#pragma once

#include "datasets_synthetic/site_folder.h"

namespace insitu::demo {

// `width`, `height` [px]: size of the photographs.
SiteDescription DescribeBridge(int width, int height);

}  // namespace insitu::demo
