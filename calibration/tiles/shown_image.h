// SPDX-License-Identifier: GPL-3.0-or-later
// A decoded image as browsers show it: cut out, encoded, pixel by pixel.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "calibration/color/color_space.h"
#include "calibration/tiles/pixel_value.h"

namespace insitu {

// Of an image of three channels, blue first: codes of 8 or 16 bits, or numbers, of a colour space.
PixelValue PixelValueAt(const cv::Mat& image, const ColorSpace& color, int x, int y);

enum class TileCoding { kJpeg, kPng };  // smaller; or lossless

// The pixels of `wanted`, as 8-bit sRGB; what lies beyond the image as `border` of OpenCV says.
cv::Mat CutOut(const cv::Mat& image, const ColorSpace& color, const cv::Rect& wanted, int border);

// The file's bytes.
std::string EncodedTile(const cv::Mat& image, TileCoding coding);

}  // namespace insitu
