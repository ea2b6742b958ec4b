// SPDX-License-Identifier: GPL-3.0-or-later
// What lies in a site's folders and looks as if it were to be read, but is not.
#pragma once

#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// A sentence with its remedy for each kind: pictures in photos/ and calibration/ of formats that
// are not read (HEIC, raw, WebP ...), and photographs in calibration/ and its folders that are not
// named board_*. Empty: nothing, or no such folders.
std::vector<std::string> UnreadFiles(const SitePaths& site);

}  // namespace insitu
