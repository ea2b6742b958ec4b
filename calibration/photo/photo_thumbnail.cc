// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photo_thumbnail.h"

#include <openssl/evp.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <type_traits>
#include <variant>
#include <vector>

#include "calibration/files/raw_ending.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/photo/raw_photograph.h"

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

constexpr char kExr[] = "\x76\x2f\x31\x01";

// By OpenCV, in codes of 8 bits, blue first, about `width` pixels wide or more. A quarter of the
// size costs a JPEG's decoder little.
cv::Mat Decoded(const std::string& content, bool is_large) {
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(content.size()), CV_8U, const_cast<char*>(content.data())),
      (is_large ? cv::IMREAD_REDUCED_COLOR_4 : cv::IMREAD_COLOR) | cv::IMREAD_IGNORE_ORIENTATION);
}

// The same of any photograph, as sRGB.
cv::Mat Developed(CodedPhotograph photo) {
  cv::Mat image(photo.height, photo.width, CV_8UC3);
  std::visit(
      [&](const auto& samples) {
        using Sample = typename std::decay_t<decltype(samples)>::value_type;
        const double highest =
            std::is_floating_point_v<Sample> ? 1 : double(std::numeric_limits<Sample>::max());
        image.forEach<cv::Vec3b>([&](cv::Vec3b& code, const int* at) {
          const Sample* rgb = &samples[(static_cast<size_t>(at[0]) * photo.width + at[1]) * 3];
          const Eigen::Vector3d encoded = Eigen::Vector3d(rgb[0], rgb[1], rgb[2]) / highest;
          const bool is_light = std::is_floating_point_v<Sample> && photo.color.IsDefault();
          code = SrgbCode(is_light ? encoded : photo.color.Linear(encoded));
        });
      },
      photo.samples);
  return image;
}

}  // namespace

std::optional<std::string> PhotoThumbnail(const std::filesystem::path& photograph, int width) {
  cv::Mat image, small;
  bool is_srgb = true;
  if (HasRawEnding(photograph)) {
    RawPhotograph raw = ReadRawPhotograph(photograph, true);
    image = Developed({raw.width, raw.height, std::move(raw.codes), raw.color});
  } else {
    const std::string content = ReadWhole(photograph);
    if (content.starts_with(kExr)) return std::nullopt;
    const bool is_large = ReadPhotographSize(photograph).x() >= 4 * width;
    is_srgb = !content.starts_with("\xff\xd8") && !content.starts_with("\x89PNG");
    image = is_srgb ? Developed(ReadCodedPhotograph(photograph)) : Decoded(content, is_large);
  }
  if (image.empty()) return std::nullopt;
  cv::resize(image, small, cv::Size(width, std::max(1, image.rows * width / image.cols)), 0, 0,
             cv::INTER_AREA);
  if (!is_srgb) ShowAsSrgb(ReadPhotographColor(photograph), &small);
  std::vector<unsigned char> jpeg;
  if (!cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality})) return std::nullopt;
  return "data:image/jpeg;base64," + Base64(jpeg);
}

}  // namespace insitu
