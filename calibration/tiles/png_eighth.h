// SPDX-License-Identifier: GPL-3.0-or-later
// The overview of a PNG sooner than libpng and zlib decode the whole: rows are summed by one thread
// while another one inflates the next.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace insitu {

// As ReadEighthOfPhotograph. Empty: no PNG of 8 or 16 bits whose rows stand in their order, or cut
// short or damaged, which decoding the whole will tell.
cv::Mat ReadEighthOfPng(const std::filesystem::path& path);

}  // namespace insitu
