// SPDX-License-Identifier: GPL-3.0-or-later
// Example 3: a house with arcades in a courtyard under an overcast sky.
#pragma once

#include "datasets_synthetic/site_folder.h"

namespace insitu::demo {

// `width`, `height` [px]: size of the photographs.
SiteDescription DescribeCourtyard(int width, int height);

}  // namespace insitu::demo
