// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph in small, for the report to draw on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insitu {

// A JPEG of `width` pixels as a data URI, pixels as stored (EXIF's orientation not applied), so
// that it lies under marks. nullopt: EXR, or a file that OpenCV does not read. Throws InputError:
// no photograph.
std::optional<std::string> PhotoThumbnail(const std::filesystem::path& photograph, int width = 480);

}  // namespace insitu
