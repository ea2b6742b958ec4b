// SPDX-License-Identifier: GPL-3.0-or-later
// Example 1: solids of paint and stone about the campus's gallery.
#pragma once

#include "datasets_synthetic/site_folder.h"

namespace insitu::demo {

// `width`, `height` [px]: size of the photographs.
SiteDescription DescribeGallery(int width, int height);

}  // namespace insitu::demo
