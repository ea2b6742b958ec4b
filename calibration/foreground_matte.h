// SPDX-License-Identifier: GPL-3.0-or-later
// survey/foreground/<photo>.png: which part of each pixel something in front of the building
// covers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/photo/raster.h"
#include "calibration/program/site.h"

namespace insitu {

// The share 0..1 of each pixel (code 255, or 65535 of 16 bits, is 1) in the photograph's frame, one
// channel; nullopt: no such file. Throws InputError: not grey, of another size, not 8 or 16 bits.
std::optional<Raster> ReadForegroundMatte(const SitePaths& site, const std::string& photo,
                                          int width, int height);

// Files in survey/foreground/ that belong to no photograph, a line each.
std::vector<std::string> UnreadForegroundFiles(const SitePaths& site);

}  // namespace insitu
