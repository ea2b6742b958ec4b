// SPDX-License-Identifier: GPL-3.0-or-later
// ICC profiles, by LittleCMS. [ICC.1:2010]
#pragma once

#include <filesystem>
#include <string>

#include "calibration/color/color_space.h"

namespace insitu {

// What a profile of `channels` colour channels (3: RGB, 1: grey) in the file `path` says, matrix
// and curves or tables, of version 2 or 4, relative to its white. Throws InputError: damaged, of
// another number of channels, or of a class that no picture may hold.
ColorSpace ReadIccProfile(const std::string& profile, int channels,
                          const std::filesystem::path& path);

// RGB by primaries and one curve for all channels, with a profile that says so. The same arguments
// give the same bytes.
ColorSpace MakeColorSpace(const std::string& name, const Primaries& primaries,
                          const TransferFunction& transfer);

}  // namespace insitu
