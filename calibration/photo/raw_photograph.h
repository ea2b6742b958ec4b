// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's raw data, by LibRaw: linear, in the camera's own primaries, unsharpened, uncorrected.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

struct RawPhotograph {
  int width = 0, height = 0;    // [px]
  std::vector<uint16_t> codes;  // three channels, rows of red, green and blue
  ColorSpace color = {};
};

// Codes of 16 bits above black, 65535 where the sensor clipped, each channel by itself: a pixel is
// marked so that has a clipped sample of the sensor beside it. The colour space takes them to
// linear Rec. 709, balanced for daylight (D65), the same for all photographs of a camera, white at
// 1 where its first channel clips. The frame is the sensor's as LibRaw shows it, not turned.
// `is_half`: one pixel of 2 x 2 samples, in a fraction of the time.
// Each throws InputError: cut short, damaged, over 536 megapixels, a camera that LibRaw does not
// know or whose colours it does not know.
RawPhotograph ReadRawPhotograph(const std::filesystem::path& path, bool is_half = false);
ColorSpace ReadRawColor(const std::filesystem::path& path);
Eigen::Vector2i ReadRawSize(const std::filesystem::path& path);  // [px]
int ReadRawOrientation(const std::filesystem::path& path);       // as EXIF counts

}  // namespace insitu
