// SPDX-License-Identifier: GPL-3.0-or-later
// A decoded photograph and its halvings.
#pragma once

#include <filesystem>
#include <mutex>
#include <opencv2/core.hpp>
#include <vector>

#include "calibration/color/color_space.h"

namespace insitu {

// By how the file begins.
bool IsJpeg(const std::filesystem::path& path);

// The pixels as in the file, EXIF's orientation not applied, three channels, blue first: 8 or 16
// bit codes, or numbers, of its own colour space. Throws InputError: cannot be decoded.
cv::Mat ReadShownPhotograph(const std::filesystem::path& path);

// In a fraction of the time: one pixel for 8 x 8, their mean; the size rounded up. Empty: no JPEG,
// nor a PNG or TIFF of the common kinds. Throws InputError: a damaged JPEG; others are empty.
cv::Mat ReadEighthOfPhotograph(const std::filesystem::path& path);

// The mean of 2 x 2 pixels each; an odd last column or row counts twice.
cv::Mat HalvedImage(const cv::Mat& image);

// As 8-bit sRGB, from codes or numbers of a colour space.
cv::Mat EightBit(const cv::Mat& image, const ColorSpace& color = {});

// The levels of an image, made when they are asked for. Any thread may ask.
class PhotoPyramid {
 public:
  // `first`: the level that `image` is.
  PhotoPyramid(cv::Mat image, int first) : first_(first), levels_{std::move(image)} {}
  cv::Mat Level(int level);  // `first` or above; shares its pixels
  size_t bytes() const;      // with all levels

 private:
  const int first_;
  std::mutex mutex_;
  std::vector<cv::Mat> levels_;
};

}  // namespace insitu
