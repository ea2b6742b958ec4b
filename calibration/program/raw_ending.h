// SPDX-License-Identifier: GPL-3.0-or-later
// Which files are a camera's raw data.
#pragma once

#include <filesystem>

namespace insitu {

// Whether a name ends as a camera's raw data do (.dng, .nef, .cr3 ...), in any case.
bool HasRawEnding(const std::filesystem::path& name);

}  // namespace insitu
