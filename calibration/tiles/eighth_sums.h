// SPDX-License-Identifier: GPL-3.0-or-later
// An image an eighth as wide and as high, summed while the rows of the whole are decoded, so that
// these are never all in memory.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace insitu {

class EighthSums {
 public:
  EighthSums(int width, int height);  // of the whole [px]

  // Row y, once. Samples of a pixel lie together; of one or two (grey) the first counts for all
  // colours, of three or four (RGB) the first three.
  void Add(int y, const uint8_t* row, int channels);
  void Add(int y, const uint16_t* row, int channels);
  // The rows that another one of the same size was given.
  void Add(const EighthSums& other);

  // The mean of 8 x 8 pixels each, at the edges of what is left; sizes rounded up; three channels,
  // blue first. `depth`: CV_8U or CV_16U, as the samples. All rows have been given.
  cv::Mat Means(int depth) const;

 private:
  template <typename Sample>
  void AddRow(int y, const Sample* row, int channels);

  int width_, height_;
  cv::Mat sums_;  // CV_32SC3, red first
};

}  // namespace insitu
