// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/photo_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

bool IsJpeg(std::string_view content) { return content.starts_with("\xff\xd8\xff"); }

// OpenCV fills up what is missing of a JPEG. A scan begins with FF DA and ends at FF D9, neither of
// which is within; a thumbnail's end comes before the photograph's scan.
bool IsCutShort(std::string_view jpeg) {
  const size_t end = jpeg.rfind("\xff\xd9");
  return end == std::string_view::npos || jpeg.find("\xff\xda", end) != std::string_view::npos;
}

cv::Mat DecodedJpeg(const std::filesystem::path& path, const std::string& content, int mode) {
  if (IsCutShort(content)) throw InputError(path, "is cut short, expected a whole photograph");
  cv::Mat image;
  try {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8U,
                        const_cast<char*>(content.data()));
    image = cv::imdecode(bytes, mode | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw InputError(path, "cannot be decoded: " + error.err);
  }
  if (image.empty()) throw InputError(path, "cannot be decoded, expected a photograph");
  return image;
}

// Code by linear value, fine enough that each code's own value yields it.
template <typename Code>
const std::vector<Code>& CodeTable() {
  static const std::vector<Code> table = [] {
    constexpr int kHighest = std::numeric_limits<Code>::max();
    std::vector<Code> codes(sizeof(Code) == 1 ? 1 << 16 : 1 << 21);
    for (size_t i = 0; i < codes.size(); ++i) {
      const double linear = static_cast<double>(i) / static_cast<double>(codes.size() - 1);
      codes[i] = static_cast<Code>(std::lround(kHighest * SrgbFromLinear(linear)));
    }
    return codes;
  }();
  return table;
}

template <typename Code>
cv::Mat CodesOf(const Raster& linear, int type) {
  const std::vector<Code>& table = CodeTable<Code>();
  const float highest = static_cast<float>(table.size() - 1);
  cv::Mat image(linear.height, linear.width, type);
  cv::parallel_for_(cv::Range(0, linear.height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const float* const values = linear.At(0, y);
      Code* const codes = image.ptr<Code>(y);
      for (int i = 0; i < 3 * linear.width; i += 3) {
        for (int c = 0; c < 3; ++c) {  // blue first
          codes[i + 2 - c] = table[cvRound(values[i + c] * highest)];
        }
      }
    }
  });
  return image;
}

cv::Mat FloatsOf(Raster linear) {
  cv::Mat image;
  cv::cvtColor(cv::Mat(linear.height, linear.width, CV_32FC3, linear.data.data()), image,
               cv::COLOR_RGB2BGR);
  return image;
}

// Where an axis of `size` is cut: pairs, and what is left over.
std::array<std::pair<cv::Range, cv::Range>, 2> Halvings(int size) {
  const int half = size / 2;
  return {{{cv::Range(0, 2 * half), cv::Range(0, half)},
           {cv::Range(2 * half, size), cv::Range(half, (size + 1) / 2)}}};
}

}  // namespace

cv::Mat ReadShownPhotograph(const std::filesystem::path& path) {
  const std::string content = ReadWhole(path);
  if (IsJpeg(content)) return DecodedJpeg(path, content, cv::IMREAD_COLOR);
  Photograph photo = ReadPhotograph(path);
  if (photo.encoding == Encoding::kSrgb8) return CodesOf<uint8_t>(photo.linear, CV_8UC3);
  if (photo.encoding == Encoding::kSrgb16) return CodesOf<uint16_t>(photo.linear, CV_16UC3);
  return FloatsOf(std::move(photo.linear));
}

cv::Mat ReadEighthOfPhotograph(const std::filesystem::path& path) {
  const std::string content = ReadWhole(path);
  if (!IsJpeg(content)) return {};
  return DecodedJpeg(path, content, cv::IMREAD_REDUCED_COLOR_8);
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

cv::Mat EightBit(const cv::Mat& image) {
  cv::Mat shown;
  if (image.depth() != CV_32F) {
    image.convertTo(shown, CV_8U, image.depth() == CV_16U ? 1 / 257. : 1);
    return shown;
  }
  shown.create(image.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int i = 0; i < 3 * image.cols; ++i) {
      const double value = std::clamp(static_cast<double>(image.ptr<float>(y)[i]), 0., 1.);
      shown.ptr<uint8_t>(y)[i] = static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(value)));
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
