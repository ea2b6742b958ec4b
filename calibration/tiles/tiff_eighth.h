// SPDX-License-Identifier: GPL-3.0-or-later
// The overview of a TIFF: its strips, each of which is compressed by itself, by all threads.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace insitu {

// As ReadEighthOfPhotograph. Empty: no TIFF, one in tiles or of other than grey or RGB of 8 or 16
// bits, or cut short or damaged, which decoding the whole will tell.
cv::Mat ReadEighthOfTiff(const std::filesystem::path& path);

}  // namespace insitu
