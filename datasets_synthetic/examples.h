// SPDX-License-Identifier: GPL-3.0-or-later
// The three examples of the paper, [Durisch92, section 7].
#pragma once

#include <string>
#include <vector>

#include "datasets_synthetic/site_folder.h"

namespace insitu::demo {

// gallery, bridge, courtyard: as the paper numbers them.
const std::vector<std::string>& ExampleNames();

// `width`, `height` [px]: size of the photographs. `name` is one of ExampleNames().
SiteDescription DescribeExample(const std::string& name, int width, int height);

}  // namespace insitu::demo
