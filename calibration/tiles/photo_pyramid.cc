// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "calibration/color/srgb_table.h"
#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/png_eighth.h"
#include "calibration/tiles/tiff_eighth.h"

namespace insitu {
namespace {

// OpenCV fills up what is missing of a JPEG. A scan begins with FF DA and ends at FF D9, neither of
// which is within; a thumbnail's end comes before the photograph's scan.
bool IsCutShort(std::string_view jpeg) {
  const size_t end = jpeg.rfind("\xff\xd9");
  return end == std::string_view::npos || jpeg.find("\xff\xda", end) != std::string_view::npos;
}

cv::Mat DecodedJpeg(const std::filesystem::path& path, const std::string& content, int mode) {
  if (IsCutShort(content)) {
    throw ErrorAt({path}, Sentence("photoCut", "is cut short, expected a whole photograph"));
  }
  cv::Mat image;
  try {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8U,
                        const_cast<char*>(content.data()));
    image = cv::imdecode(bytes, mode | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw ErrorAt({path},
                  Sentence("photoUndecoded", "cannot be decoded: {why}", {{"why", error.err}}));
  }
  if (image.empty()) {
    throw ErrorAt({path}, Sentence("photoNone", "cannot be decoded, expected a photograph"));
  }
  return image;
}

template <typename Sample>
cv::Mat BlueFirst(const CodedPhotograph& photo, std::vector<Sample>& samples) {
  const cv::Mat rgb(photo.height, photo.width, CV_MAKETYPE(cv::DataType<Sample>::depth, 3),
                    samples.data());
  cv::Mat image;
  cv::cvtColor(rgb, image, cv::COLOR_RGB2BGR);
  return image;
}

// Codes or numbers as [0, 1], through a colour space that is not the default.
cv::Mat Shown(const cv::Mat& image, const ColorSpace& color) {
  cv::Mat encoded, shown(image.size(), CV_8UC3);
  const double highest = image.depth() == CV_8U ? 255 : image.depth() == CV_16U ? 65535 : 1;
  image.convertTo(encoded, CV_64F, 1 / highest);
  shown.forEach<cv::Vec3b>([&](cv::Vec3b& code, const int* at) {
    const auto& blue_first = encoded.at<cv::Vec3d>(at[0], at[1]);
    const Eigen::Vector3d linear = color.Linear({blue_first[2], blue_first[1], blue_first[0]});
    for (int c = 0; c < 3; ++c) {
      const double value = std::clamp(linear[c], 0., 1.);
      code[2 - c] = static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(value)));
    }
  });
  return shown;
}

// Where an axis of `size` is cut: pairs, and what is left over.
std::array<std::pair<cv::Range, cv::Range>, 2> Halvings(int size) {
  const int half = size / 2;
  return {{{cv::Range(0, 2 * half), cv::Range(0, half)},
           {cv::Range(2 * half, size), cv::Range(half, (size + 1) / 2)}}};
}

}  // namespace

bool IsJpeg(const std::filesystem::path& path) {
  char start[3] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  return std::string_view(start, sizeof start) == "\xff\xd8\xff";
}

cv::Mat ReadShownPhotograph(const std::filesystem::path& path) {
  if (IsJpeg(path)) return DecodedJpeg(path, ReadWhole(path), cv::IMREAD_COLOR);
  CodedPhotograph photo = ReadCodedPhotograph(path);
  return std::visit([&](auto& samples) { return BlueFirst(photo, samples); }, photo.samples);
}

cv::Mat ReadEighthOfPhotograph(const std::filesystem::path& path) {
  if (IsJpeg(path)) return DecodedJpeg(path, ReadWhole(path), cv::IMREAD_REDUCED_COLOR_8);
  cv::Mat eighth = ReadEighthOfPng(path);
  return eighth.empty() ? ReadEighthOfTiff(path) : eighth;
}

cv::Mat HalvedImage(const cv::Mat& image) {
  cv::Mat half((image.rows + 1) / 2, (image.cols + 1) / 2, image.type());
  for (const auto& [rows, half_rows] : Halvings(image.rows)) {
    for (const auto& [columns, half_columns] : Halvings(image.cols)) {
      if (rows.empty() || columns.empty()) continue;
      cv::Mat part = image(rows, columns);
      if (rows.size() == 1 || columns.size() == 1) {
        cv::copyMakeBorder(part, part, 0, rows.size() % 2, 0, columns.size() % 2,
                           cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
      }
      cv::Mat target = half(half_rows, half_columns);
      cv::resize(part, target, target.size(), 0, 0, cv::INTER_AREA);
    }
  }
  return half;
}

cv::Mat EightBit(const cv::Mat& image, const ColorSpace& color) {
  if (!color.IsDefault()) return Shown(image, color);
  cv::Mat shown;
  if (image.depth() != CV_32F) {
    image.convertTo(shown, CV_8U, image.depth() == CV_16U ? 1 / 257. : 1);
    return shown;
  }
  shown.create(image.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int i = 0; i < 3 * image.cols; ++i) {
      shown.ptr<uint8_t>(y)[i] = NearestSrgbCode(image.ptr<float>(y)[i]);
    }
  }
  return shown;
}

cv::Mat PhotoPyramid::Level(int level) {
  INSITU_CHECK(level >= first_);
  const std::lock_guard lock(mutex_);
  while (first_ + static_cast<int>(levels_.size()) <= level) {
    levels_.push_back(HalvedImage(levels_.back()));
  }
  return levels_[level - first_];
}

size_t PhotoPyramid::bytes() const {
  const cv::Mat& image = levels_.front();  // never changes
  return image.total() * image.elemSize() * 4 / 3;
}

}  // namespace insitu
