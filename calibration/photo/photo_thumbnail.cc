// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photo_thumbnail.h"

#include <openssl/evp.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"

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

// Blue comes first.
void ShowAsSrgb(const ColorSpace& color, cv::Mat* image) {
  if (color.IsDefault()) return;
  image->forEach<cv::Vec3b>([&](cv::Vec3b& code, const int*) {
    const Eigen::Vector3d linear = color.Linear(Eigen::Vector3d(code[2], code[1], code[0]) / 255);
    for (int c = 0; c < 3; ++c) {
      code[2 - c] =
          cv::saturate_cast<uint8_t>(255 * SrgbFromLinear(std::clamp(linear[c], 0.0, 1.0)));
    }
  });
}

}  // namespace

std::optional<std::string> PhotoThumbnail(const std::filesystem::path& photograph, int width) {
  const std::string content = ReadWhole(photograph);
  if (content.starts_with("\x76\x2f\x31\x01")) return std::nullopt;  // EXR
  // A quarter of the size costs a JPEG's decoder little.
  const bool is_large = ReadPhotographSize(photograph).x() >= 4 * width;
  const cv::Mat image = cv::imdecode(
      cv::Mat(1, static_cast<int>(content.size()), CV_8U, const_cast<char*>(content.data())),
      (is_large ? cv::IMREAD_REDUCED_COLOR_4 : cv::IMREAD_COLOR) | cv::IMREAD_IGNORE_ORIENTATION);
  if (image.empty()) return std::nullopt;
  cv::Mat small;
  cv::resize(image, small, cv::Size(width, std::max(1, image.rows * width / image.cols)), 0, 0,
             cv::INTER_AREA);
  ShowAsSrgb(ReadPhotographColor(photograph), &small);
  std::vector<unsigned char> jpeg;
  if (!cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality})) return std::nullopt;
  return "data:image/jpeg;base64," + Base64(jpeg);
}

}  // namespace insitu
