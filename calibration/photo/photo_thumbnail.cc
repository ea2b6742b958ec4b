// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photo_thumbnail.h"

#include <openssl/evp.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <variant>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/photo/raw_photograph.h"
#include "calibration/program/raw_ending.h"

namespace insitu {
namespace {

constexpr int kQuality = 70;

std::string Base64(const std::vector<unsigned char>& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // OpenSSL ends it with a zero
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                  static_cast<int>(bytes.size()));
  text.pop_back();
  return text;
}

// Blue first.
cv::Vec3b SrgbCode(const Eigen::Vector3d& linear) {
  cv::Vec3b code;
  for (int c = 0; c < 3; ++c) {
    code[2 - c] = cv::saturate_cast<uint8_t>(255 * SrgbFromLinear(std::clamp(linear[c], 0.0, 1.0)));
  }
  return code;
}

void ShowAsSrgb(const ColorSpace& color, cv::Mat* image) {
  if (color.IsDefault()) return;
  image->forEach<cv::Vec3b>([&](cv::Vec3b& code, const int*) {
    code = SrgbCode(color.Linear(Eigen::Vector3d(code[2], code[1], code[0]) / 255));
  });
}

// Codes of 8 bits, blue first, about `width` pixels wide or more; empty: OpenCV does not read it.
cv::Mat Decoded(const std::filesystem::path& photograph, int width) {
  const std::string content = ReadWhole(photograph);
  if (content.starts_with("\x76\x2f\x31\x01")) return {};  // EXR
  // A quarter of the size costs a JPEG's decoder little.
  const bool is_large = ReadPhotographSize(photograph).x() >= 4 * width;
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(content.size()), CV_8U, const_cast<char*>(content.data())),
      (is_large ? cv::IMREAD_REDUCED_COLOR_4 : cv::IMREAD_COLOR) | cv::IMREAD_IGNORE_ORIENTATION);
}

// The same of raw, as sRGB: the camera's linear codes are too coarse in 8 bits.
cv::Mat DecodedRaw(const std::filesystem::path& photograph) {
  CodedPhotograph raw = ReadRawPhotograph(photograph, true);
  const auto& codes = std::get<std::vector<uint16_t>>(raw.samples);
  cv::Mat image(raw.height, raw.width, CV_8UC3);
  image.forEach<cv::Vec3b>([&](cv::Vec3b& code, const int* at) {
    const uint16_t* rgb = &codes[(static_cast<size_t>(at[0]) * raw.width + at[1]) * 3];
    code = SrgbCode(raw.color.Linear(Eigen::Vector3d(rgb[0], rgb[1], rgb[2]) / 65535));
  });
  return image;
}

}  // namespace

std::optional<std::string> PhotoThumbnail(const std::filesystem::path& photograph, int width) {
  const bool is_raw = HasRawEnding(photograph);
  const cv::Mat image = is_raw ? DecodedRaw(photograph) : Decoded(photograph, width);
  if (image.empty()) return std::nullopt;
  cv::Mat small;
  cv::resize(image, small, cv::Size(width, std::max(1, image.rows * width / image.cols)), 0, 0,
             cv::INTER_AREA);
  if (!is_raw) ShowAsSrgb(ReadPhotographColor(photograph), &small);
  std::vector<unsigned char> jpeg;
  if (!cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality})) return std::nullopt;
  return "data:image/jpeg;base64," + Base64(jpeg);
}

}  // namespace insitu
