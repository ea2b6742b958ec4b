// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/eighth_sums.h"

#include <algorithm>

namespace insitu {
namespace {

constexpr int kEighth = 8;

int EighthOf(int size) { return (size + kEighth - 1) / kEighth; }

// How many pixels one at `index` stands for, along one axis.
int CountAt(int index, int size) { return std::min(kEighth, size - index * kEighth); }

}  // namespace

EighthSums::EighthSums(int width, int height)
    : width_(width),
      height_(height),
      sums_(EighthOf(height), EighthOf(width), CV_32SC3, cv::Scalar::all(0)) {}

template <typename Sample>
void EighthSums::AddRow(int y, const Sample* row, int channels) {
  auto* sum = sums_.ptr<cv::Vec3i>(y / kEighth);
  const int green = channels < 3 ? 0 : 1, blue = channels < 3 ? 0 : 2;
  for (int x = 0; x < width_; x += kEighth, ++sum) {
    int r = 0, g = 0, b = 0;
    for (int i = std::min(kEighth, width_ - x); i > 0; --i, row += channels) {
      r += row[0];
      g += row[green];
      b += row[blue];
    }
    *sum += cv::Vec3i(r, g, b);
  }
}

void EighthSums::Add(int y, const uint8_t* row, int channels) { AddRow(y, row, channels); }

void EighthSums::Add(int y, const uint16_t* row, int channels) { AddRow(y, row, channels); }

void EighthSums::Add(const EighthSums& other) { sums_ += other.sums_; }

cv::Mat EighthSums::Means(int depth) const {
  cv::Mat means(sums_.size(), CV_MAKETYPE(depth, 3));
  for (int y = 0; y < sums_.rows; ++y) {
    for (int x = 0; x < sums_.cols; ++x) {
      const auto& sum = sums_.at<cv::Vec3i>(y, x);
      const int count = CountAt(x, width_) * CountAt(y, height_);
      for (int c = 0; c < 3; ++c) {
        const int mean = (sum[2 - c] + count / 2) / count;
        if (depth == CV_8U) {
          means.at<cv::Vec3b>(y, x)[c] = static_cast<uint8_t>(mean);
        } else {
          means.at<cv::Vec3w>(y, x)[c] = static_cast<uint16_t>(mean);
        }
      }
    }
  }
  return means;
}

}  // namespace insitu
